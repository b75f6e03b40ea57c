#include "elements/pixel_spots.hpp"

#include "base/error.hpp"
#include "base/format.hpp"
#include "base/parallel.hpp"
#include "elements/connected_pixels.hpp"
#include "interaction/kernel.hpp"

namespace rsc {
namespace {

// Number of pixels N such that half of all pixels belong to contacts of at most N pixels.
template <class Sums>
double median_by_area(const Sums& sums) {
    std::vector<long> sizes;
    long all = 0;
    for (const auto& s : sums) {
        sizes.push_back(s.pixels);
        all += s.pixels;
    }
    std::sort(sizes.begin(), sizes.end());
    long so_far = 0;
    std::size_t k = 0;
    while (2 * (so_far += sizes[k]) < all) ++k;
    return static_cast<double>(sizes[k]);
}

}  // namespace

const HeightMap& require_elements(const HeightMap& heights, const Indenter& indenter,
                                  const SolverOptions& options) {
    require_sound(indenter);
    if (!(options.tolerance > 0)) throw Error(Failure::bad_input, "the tolerance must be positive");
    if (heights.nx < 1 || heights.ny < 1 || !(heights.dx > 0) || !(heights.dy > 0))
        throw Error(Failure::bad_input, "boundary elements: the map of heights is empty");
    constexpr double thinnest = 32;
    const bool ridges = heights.ny == 1 && std::isfinite(indenter.period.y);
    if (!ridges && (heights.dx > thinnest * heights.dy || heights.dy > thinnest * heights.dx))
        throw Error(Failure::bad_input, "boundary elements: pixels of " + text_of(heights.dx) +
                                            " by " + text_of(heights.dy) +
                                            " are longer than 32 times their width");
    return heights;
}

namespace {

// Sums over the pixels of a contact.
struct ContactSum {
    double p = 0, weight = 0, px = 0, py = 0, highest = 0, own = 0;
    // hard: pixels at the hardness; border: sides without a neighbour of the other pixels.
    long pixels = 0, hard = 0, border = 0;
    Pixel peak{0, 0};
};

// The sides of each pixel that are borders of contacts. Beyond a border of the map that does not
// repeat the contact may continue.
std::vector<int> borders(const std::vector<Pixel>& touching, const HeightMap& map, int period_x,
                         int period_y) {
    std::vector<int> open = open_sides(touching, period_x, period_y);
    for (std::size_t k = 0; k < open.size(); ++k) {
        if (period_x == 0) open[k] -= (touching[k].x == 0) + (touching[k].x == map.nx - 1);
        if (period_y == 0) open[k] -= (touching[k].y == 0) + (touching[k].y == map.ny - 1);
    }
    return open;
}

// Adds moments about the pixels of the highest pressure, and the deflections of these pixels by
// their own contacts.
void add_about_peaks(const std::vector<Pixel>& touching, const std::vector<int>& label,
                     const std::vector<double>& pressure, double tension, const HeightMap& map,
                     const Indenter& indenter, int period_x, int period_y,
                     std::vector<ContactSum>& sums) {
    // Positions to the nearest image.
    const auto nearest = [](int offset, int n) {
        if (n == 0) return offset;
        if (2 * offset > n) return offset - n;
        return 2 * offset < -n ? offset + n : offset;
    };
    const Substrate substrate = substrate_of(indenter);
    const auto from_peak = [&](std::size_t k) {
        const Pixel& peak = sums[at(label[k])].peak;
        return Pixel{nearest(touching[k].x - peak.x, period_x),
                     nearest(touching[k].y - peak.y, period_y)};
    };
    std::vector<double> at_peak(touching.size());  // deflection of the peak by a unit pressure
    parallel_for(touching.size(), 512, touching.size() > 1024 ? 0 : 1, [&](std::size_t k) {
        const Pixel d = from_peak(k);
        at_peak[k] = substrate.under_pixel(d.x * map.dx, d.y * map.dy, map.dx, map.dy);
    });
    for (std::size_t k = 0; k < touching.size(); ++k) {
        ContactSum& s = sums[at(label[k])];
        const Pixel d = from_peak(k);
        s.px += (pressure[k] + tension) * d.x;
        s.py += (pressure[k] + tension) * d.y;
        s.own += pressure[k] * at_peak[k];
    }
}

}  // namespace

void add_pixels(Level& level, const HeightMap& map, const Indenter& indenter, double H0,
                const std::vector<Pixel>& touching, std::vector<double> pressure, double tension) {
    std::vector<int> label;
    const int period_x = std::isfinite(indenter.period.x) ? map.nx : 0,
              period_y = std::isfinite(indenter.period.y) ? map.ny : 0;
    const int contacts = connected_sets(touching, label, period_x, period_y);
    const std::vector<int> open = borders(touching, map, period_x, period_y);
    std::vector<ContactSum> sums(at(contacts));
    double extreme = 0;  // number of pixels
    for (std::size_t k = 0; k < touching.size(); ++k) {
        ContactSum& s = sums[at(label[k])];
        const double weight = pressure[k] + tension;
        s.p += pressure[k];
        s.weight += weight;
        s.pixels += 1;
        const bool yields = pressure[k] >= H0;
        s.hard += yields;
        if (!yields) s.border += open[k];
        if (pressure[k] > kExtreme * indenter.E_star) extreme += 1;
        if (weight > s.highest) {
            s.highest = weight;
            s.peak = touching[k];
        }
    }
    add_about_peaks(touching, label, pressure, tension, map, indenter, period_x, period_y, sums);
    if (!touching.empty()) {
        level.pixels_per_contact = median_by_area(sums);
        const double border = std::accumulate(open.begin(), open.end(), 0.0),
                     pressed = double(touching.size());
        const double all = double(map.nx) * map.ny;
        // Near full contact it is the gaps that have few pixels.
        const double pixels = indenter.period.finite() ? std::min(pressed, all - pressed) : pressed;
        if (pixels > 0) {
            level.border_share = border / pixels;
            level.border_runs =
                std::sqrt(squares_of_straight_parts(touching, period_x, period_y)) / pixels;
        }
        level.pressure_max = *std::max_element(pressure.begin(), pressure.end());
    }
    const auto inside = [](double column, int n) {
        return n > 0 ? column - n * std::floor(column / n) : column;
    };
    const double pixel = map.dx * map.dy;
    const double border = (pi - 1 + std::numbers::ln2) / 24;
    for (const ContactSum& s : sums) {
        const double flat = static_cast<double>(s.hard) / static_cast<double>(s.pixels);
        const double area = pixel * (static_cast<double>(s.pixels) -
                                     (1 + flat * flat) * border * static_cast<double>(s.border));
        level.add_contact(s.peak.y * map.nx + s.peak.x,
                          map.x0 + map.dx * inside(s.peak.x + s.px / s.weight, period_x),
                          map.y0 + map.dy * inside(s.peak.y + s.py / s.weight, period_y),
                          s.p * pixel, std::sqrt(area / pi), s.own);
        level.force += s.p * pixel;
        level.area += area;
        if (std::isfinite(H0)) level.yields.push_back(s.hard > 0);
        level.plastic_contacts += s.hard > 0;
    }
    if (!touching.empty())
        level.extreme_area_fraction = extreme / static_cast<double>(touching.size());
    level.area_pixels = pixel * static_cast<double>(touching.size());
    level.pixels.columns = map.nx;
    level.pixels.x0 = map.x0;
    level.pixels.y0 = map.y0;
    level.pixels.dx = map.dx;
    level.pixels.dy = map.dy;
    level.pixels.index.reserve(touching.size());
    for (const Pixel& q : touching) level.pixels.index.push_back(q.y * map.nx + q.x);
    level.pixels.contact = std::move(label);
    level.pixels.pressure = std::move(pressure);
}

}  // namespace rsc
