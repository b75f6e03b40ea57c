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
      lowering_(std::move(physics.lowering)),
      highest_(physics.highest) {
    if (!options.physics.relaxation.none()) loads_.emplace(Creep(options.physics.relaxation));
}

template <class Visit>
void PixelModel::lower_points(Visit&& visit) {
    residual_.resize(at(heights_.nx) * at(heights_.ny), 0.0);
    visit([&](const Pixel& pixel, double depth) { residual_[at(place(pixel))] += depth; });
    residual_changed();
}

void PixelModel::forget() {
    forget_solutions();
    if (loads_) loads_->forget();
    if (!history()) return;
    residual_.clear();
    if (!loads_) residual_changed();
    step(0);
}

std::vector<double> PixelModel::write() const {
    std::vector<double> numbers;
    if (loads_) {
        loads_->write(numbers);
        return numbers;
    }
    if (lowering_) return residual_;
    const auto columns = at(heights_.nx);
    for (std::size_t k = 0; k < residual_.size(); ++k)
        if (residual_[k] > 0)
            numbers.insert(numbers.end(), {double(k % columns), double(k / columns), residual_[k]});
    return numbers;
}

void PixelModel::read_depths(const std::vector<double>& numbers) {
    const auto refuse = [] {
        throw Error(Failure::bad_input, "the state does not belong to a contact of this surface");
    };
    const std::size_t points = at(heights_.nx) * at(heights_.ny);
    const auto sound = [](double depth) { return depth >= 0 && depth < 1e50; };
    if (lowering_) {
        if (!(numbers.empty() || numbers.size() == points) || !std::ranges::all_of(numbers, sound))
            refuse();
        residual_ = numbers;
        return;
    }
    residual_.assign(numbers.empty() ? 0 : points, 0.0);
    for (std::size_t k = 0; k + 2 < numbers.size(); k += 3) {
        const double column = numbers[k], row = numbers[k + 1], depth = numbers[k + 2];
        if (!(column >= 0 && column < heights_.nx && row >= 0 && row < heights_.ny && sound(depth)))
            refuse();
        residual_[static_cast<std::size_t>(row) * at(heights_.nx) +
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
    step(0);
}

// The depths become twice the present ones less the coarse ones, nowhere less than before. Their
// sum is exact for a force that changes linearly, and is kept.
void PixelModel::extrapolate(const std::vector<double>& before, const std::vector<double>& coarse) {
    const auto of = [](const std::vector<double>& depths, std::size_t k) {
        return depths.empty() ? 0.0 : depths[k];
    };
    double wanted = 0, sum = 0;
    for (std::size_t k = 0; k < residual_.size(); ++k) {
        residual_[k] = 2 * residual_[k] - of(coarse, k) - of(before, k);
        wanted += residual_[k];
        residual_[k] = std::max(residual_[k], 0.0);
        sum += residual_[k];
    }
    for (std::size_t k = 0; k < residual_.size(); ++k)
        residual_[k] = of(before, k) + (sum > 0 ? residual_[k] * (wanted / sum) : 0.0);
    residual_changed();
}

void PixelModel::solve_again(double z, const Level& level) {
    start_from(z, level);
    // Two worn flats may be in full contact, where only their force is known.
    if (!(lowering_ && level.force > 0 && solve_under(level.force))) (void)solve(z, false);
    accepted_ = true;
}

ResidualProfile PixelModel::residual_profile() const {
    ResidualProfile profile{{}, {}, {}, heights_.dx, heights_.dy};
    for (std::size_t k = 0; k < residual_.size(); ++k) {
        if (!(residual_[k] > 0)) continue;
        const Pixel pixel = pixel_at(static_cast<std::int32_t>(k));
        profile.x.push_back(x(pixel.x));
        profile.y.push_back(y(pixel.y));
        profile.depth.push_back(residual_[k]);
    }
    return profile;
}

std::optional<Level> PixelModel::lasting_loads(const Level& level) const {
    if (!loads_) return {};
    Level lasting = level;
    lasting.pixels.index.clear();
    for (const Pixel& pixel : loaded_pixels())
        lasting.pixels.index.push_back(pixel.y * frame.nx + pixel.x);
    lasting.pixels.pressure = loads_->lasting();
    return lasting;
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
    if (lowering_) {
        if (const double depth = rate(); depth > 0 && !pixels.index.empty()) {
            settle();
            lower_points([&](auto&& lower) {
                for (std::size_t k = 0; k < pixels.index.size(); ++k)
                    lower(pixel_of(pixels, k), depth * pixels.pressure[k]);
            });
        }
        lowering_->measure(level, heights_, residual_);
        return step(0);
    }
    if (!pixels.index.empty())
        lower_points([&](auto&& lower) {
            for (const auto& [pixel, depth] : press_out()) lower(pixel, depth);
        });
    level.plastic_work =
        highest_ * pixel_area() * std::accumulate(residual_.begin(), residual_.end(), 0.0);
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
    step(0);
}

Level PixelModel::report(double Z0, const ElementsOutcome& outcome, std::size_t candidates,
                         const std::vector<Pixel>& touching, std::vector<double> pressure) {
    Level level;
    level.separation = Z0;
    level.candidates = static_cast<std::int32_t>(candidates);
    level.iterations = outcome.iterations;
    level.products = outcome.products;
    level.residual = outcome.residual;
    level.method = Method::automatic;
    level.converged = outcome.converged;
    for (double& p : pressure) p /= scale();
    add_pixels(level, frame, indenter_, highest_, touching, std::move(pressure));
    number_by_map(level);
    return level;
}

}  // namespace rsc
