#include "elements/pixel_model.hpp"

#include "base/error.hpp"
#include "elements/pixel_spots.hpp"

namespace rsc {

PixelModel::PixelModel(const HeightMap& heights, const Indenter& indenter,
                       const SolverOptions& options)
    : CutMap(require_elements(heights, indenter, options)),
      heights_(heights),
      indenter_(indenter),
      options_(options) {
    if (!options.relaxation.none()) loads_.emplace(Creep(options.relaxation));
}

std::vector<std::pair<std::int32_t, double>> PixelModel::residual() const {
    std::vector<std::pair<std::int32_t, double>> points(residual_.begin(), residual_.end());
    std::sort(points.begin(), points.end());
    return points;
}

void PixelModel::set_residual(Depths depths) {
    residual_ = std::move(depths);
    lowered_.assign(residual_.empty() ? 0
                                      : static_cast<std::size_t>(heights_.nx) *
                                            static_cast<std::size_t>(heights_.ny),
                    false);
    for (const auto& [k, depth] : residual_) lowered_[static_cast<std::size_t>(k)] = true;
    residual_changed();
}

void PixelModel::forget() {
    forget_solutions();
    if (loads_) {
        loads_->forget();
        step_changed();
    } else if (yields()) {
        set_residual({});
    }
}

std::vector<double> PixelModel::write() const {
    std::vector<double> numbers;
    if (loads_) {
        loads_->write(numbers);
        return numbers;
    }
    for (const auto& [k, depth] : residual())
        numbers.insert(numbers.end(), {double(k % heights_.nx), double(k / heights_.nx), depth});
    return numbers;
}

void PixelModel::read(const std::vector<double>& numbers) {
    if (loads_) {
        const auto& places = loads_->places();
        if (loads_->read(numbers) != numbers.size() ||
            (!places.empty() && places.back() / heights_.nx >= heights_.ny))
            throw Error(Failure::bad_input, "the state of the loads does not belong to this map");
        step(0);
    } else {
        Depths depths;
        for (std::size_t k = 0; k + 2 < numbers.size(); k += 3) {
            const double column = numbers[k], row = numbers[k + 1], depth = numbers[k + 2];
            if (!(column >= 0 && column < heights_.nx && row >= 0 && row < heights_.ny &&
                  depth > 0 && depth < 1e50))
                throw Error(Failure::bad_input,
                            "the state does not belong to a contact of this surface");
            depths[static_cast<std::int32_t>(row) * heights_.nx +
                   static_cast<std::int32_t>(column)] += depth;
        }
        set_residual(std::move(depths));
    }
    forget_solutions();
}

void PixelModel::solve_again(double z, const Level& level) {
    start_from(z, level);
    (void)solve(z, false);
    accepted_ = true;
}

ResidualProfile PixelModel::residual_profile() const {
    ResidualProfile profile{{}, {}, {}, heights_.dx, heights_.dy};
    for (const auto& [k, depth] : residual()) {
        const Pixel pixel = pixel_at(k);
        profile.x.push_back(x(pixel.x));
        profile.y.push_back(y(pixel.y));
        profile.depth.push_back(depth);
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
    if (loads_) {
        std::vector<std::pair<std::int32_t, double>> loaded;
        const LevelPixels& pixels = level.pixels;
        for (std::size_t k = 0; k < pixels.index.size(); ++k)
            loaded.emplace_back(
                place({pixels.index[k] % pixels.columns, pixels.index[k] / pixels.columns}),
                pixels.pressure[k]);
        std::sort(loaded.begin(), loaded.end());
        std::vector<std::int32_t> where;
        std::vector<double> p;
        for (const auto& [point, pressure] : loaded) {
            where.push_back(point);
            p.push_back(pressure);
        }
        loads_->accept(where, p, [&](const std::vector<double>& q) {
            return deflections(loaded_pixels(), q);
        });
        level.energy_lost = pixel_area() * loads_->lost();
    } else {
        if (!level.pixels.index.empty()) {
            Depths depths = residual_;
            for (const auto& [pixel, depth] : press_out()) depths[place(pixel)] += depth;
            set_residual(std::move(depths));
        }
        double sum = 0;
        for (const auto& [k, depth] : residual()) sum += depth;
        level.plastic_work = options_.hardness.H0 * pixel_area() * sum;
    }
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
    add_pixels(level, frame, indenter_, options_.hardness.H0, touching, std::move(pressure));
    number_by_map(level);
    return level;
}

}  // namespace rsc
