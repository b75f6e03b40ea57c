#include "elements/pixel_model.hpp"

#include "base/error.hpp"
#include "elements/pixel_spots.hpp"

namespace rsc {
namespace {

Pixel pixel_of(const LevelPixels& pixels, std::size_t k) {
    return {pixels.index[k] % pixels.columns, pixels.index[k] / pixels.columns};
}

}  // namespace

PixelModel::PixelModel(const HeightMap& heights, const Indenter& indenter,
                       const SolverOptions& options, ElementPhysics physics)
    : CutMap(require_elements(heights, indenter, options)),
      heights_(heights),
      indenter_(indenter),
      options_(options),
      loads_(std::move(physics.loads)),
      lowering_(std::move(physics.lowering)),
      highest_(physics.highest) {}

template <class Visit>
void PixelModel::lower(std::vector<double>& depths, Visit&& visit) {
    depths.resize(at(heights_.nx) * at(heights_.ny), 0.0);
    visit([&](const Pixel& pixel, double depth) { depths[at(place(pixel))] += depth; });
}

void PixelModel::forget() {
    forget_solutions();
    if (loads_) loads_->forget();
    if (!history()) return;
    lowered_points_.clear();
    yielded_.clear();
    if (!loads_) residual_changed();
    step(0, 0);
}

std::vector<double> PixelModel::write() const {
    std::vector<double> numbers;
    if (loads_) {
        loads_->write(numbers);
        return numbers;
    }
    if (lowering_) numbers = lowered_points_;
    const auto columns = at(heights_.nx);
    const std::vector<double>& depths = yielded();
    for (std::size_t k = 0; k < depths.size(); ++k)
        if (depths[k] > 0)
            numbers.insert(numbers.end(), {double(k % columns), double(k / columns), depths[k]});
    return numbers;
}

void PixelModel::read_depths(const std::vector<double>& numbers) {
    const auto refuse = [] {
        throw Error(Failure::bad_input, "the state does not belong to a contact of this surface");
    };
    const std::size_t points = at(heights_.nx) * at(heights_.ny);
    const auto sound = [](double depth) { return depth >= 0 && depth < 1e50; };
    const std::size_t worn = lowering_ && !numbers.empty() ? points : 0;
    if (numbers.size() < worn || (numbers.size() - worn) % 3 != 0 ||
        (numbers.size() > worn && !limited()))
        refuse();
    lowered_points_.assign(numbers.begin(), numbers.begin() + std::ptrdiff_t(worn));
    if (!std::ranges::all_of(lowered_points_, sound)) refuse();
    std::vector<double>& yielded = lowering_ ? yielded_ : lowered_points_;
    yielded.assign(numbers.size() > worn ? points : 0, 0.0);
    for (std::size_t k = worn; k < numbers.size(); k += 3) {
        const double column = numbers[k], row = numbers[k + 1], depth = numbers[k + 2];
        if (!(column >= 0 && column < heights_.nx && row >= 0 && row < heights_.ny && sound(depth)))
            refuse();
        yielded[static_cast<std::size_t>(row) * at(heights_.nx) +
                static_cast<std::size_t>(column)] += depth;
    }
}

void PixelModel::read(const std::vector<double>& numbers) {
    if (loads_) {
        const auto& places = loads_->places();
        if (loads_->read(numbers) != numbers.size() ||
            (!places.empty() && places.back() / heights_.nx >= heights_.ny))
            throw Error(Failure::bad_input, "the state of the loads does not belong to this map");
    } else {
        read_depths(numbers);
        residual_changed();
    }
    step(0, 0);
}

void PixelModel::solve_again(double z, const Level& level) {
    start_from(z, level);
    // In full contact of two flats the separation does not determine the level, and worn flats are
    // in full contact in the course of time.
    const bool by_force =
        lowering_ || level.pixels.index.size() == at(heights_.nx) * at(heights_.ny);
    if (!(by_force && level.force > 0 && solve_under(level.force))) (void)solve(z, false);
    accepted_ = true;
}

Remains PixelModel::remains(const Level& level) const {
    ResidualProfile profile{{}, {}, {}, heights_.dx, heights_.dy};
    for (std::size_t k = 0; k < lowered_points_.size(); ++k) {
        if (!(lowered_points_[k] > 0)) continue;
        const Pixel pixel = pixel_at(static_cast<std::int32_t>(k));
        profile.x.push_back(x(pixel.x));
        profile.y.push_back(y(pixel.y));
        profile.depth.push_back(lowered_points_[k]);
    }
    if (!loads_) return {.residual_profile = std::move(profile)};
    Level lasting = level;
    lasting.pixels.index.clear();
    for (const Pixel& pixel : loaded_pixels())
        lasting.pixels.index.push_back(pixel.y * frame.nx + pixel.x);
    lasting.pixels.pressure = loads_->lasting();
    lasting.pixels.contact.clear();
    return {.lasting_loads = std::move(lasting)};
}

std::vector<Pixel> PixelModel::loaded_pixels() const {
    std::vector<Pixel> pixels;
    for (const std::int32_t i : loads_->places()) pixels.push_back(pixel_at(i));
    return pixels;
}

void PixelModel::accept(Level& level) {
    accepted_ = true;
    const LevelPixels& pixels = level.pixels;
    if (loads_) return accept_loads(level);
    const double worn = lowering_ ? lowering_->lasting_rate() : 0.0;
    // A first stage of a step of sliding wears other depths than it was solved with.
    const bool stage = worn != rate();
    if (worn > 0 && !pixels.index.empty()) {
        // The last solution remains that of the lowered points.
        if (!stage) settle();
        lower(lowered_points_, [&](auto&& add) {
            for (std::size_t k = 0; k < pixels.index.size(); ++k)
                add(pixel_of(pixels, k), worn * pixels.pressure[k]);
        });
    }
    if (limited() && !stage && !pixels.index.empty()) {
        const auto pressed_out = press_out();
        const auto press = [&](std::vector<double>& depths) {
            lower(depths, [&](auto&& add) {
                for (const auto& [pixel, depth] : pressed_out) add(pixel, depth);
            });
        };
        press(lowered_points_);
        if (lowering_) press(yielded_);
    }
    if (!lowered_points_.empty()) residual_changed();
    if (limited()) level.plastic_work = highest_ * pixel_area() * sum_of(yielded());
    if (lowering_) {
        lowering_->measure(level, heights_, indenter_, lowered_points_, yielded_);
        step(0, 0);
    }
}

void PixelModel::accept_loads(Level& level) {
    std::vector<std::pair<std::int32_t, double>> loaded;
    const LevelPixels& pixels = level.pixels;
    for (std::size_t k = 0; k < pixels.index.size(); ++k)
        loaded.emplace_back(place(pixel_of(pixels, k)), pixels.pressure[k]);
    std::sort(loaded.begin(), loaded.end());
    std::vector<std::int32_t> where;
    std::vector<double> p;
    for (const auto& [point, pressure] : loaded) {
        where.push_back(point);
        p.push_back(pressure);
    }
    loads_->accept(where, p,
                   [&](const std::vector<double>& q) { return deflections(loaded_pixels(), q); });
    level.energy_lost = pixel_area() * loads_->lost();
    step(0, 0);
}

Level PixelModel::report(double Z0, const ElementsOutcome& outcome, std::size_t candidates,
                         const std::vector<Pixel>& touching, std::vector<double> pressure) {
    Level level;
    level.separation = Z0;
    level.candidates = static_cast<std::int32_t>(candidates);
    level.iterations = outcome.iterations;
    level.products = outcome.products;
    level.residual = outcome.residual;
    level.certificate = outcome.certificate;
    level.method = Method::automatic;
    level.converged = outcome.converged;
    for (double& p : pressure) p /= scale();
    add_pixels(level, frame, indenter_, highest_, touching, std::move(pressure));
    number_by_map(level);
    return level;
}

}  // namespace rsc
