#include "run/resolution.hpp"

#include <algorithm>
#include <cmath>

#include "contact/element_contact.hpp"
#include "error.hpp"
#include "rough/resample.hpp"

namespace rsc {
namespace {

// A map of more points than this is not solved on a finer grid: that would take as long as the rest of a run.
constexpr double kMostPoints = 1 << 20;

// Expected error of N of contacts of a pixel, which is taken to fall as the third power of a contact's radius in pixels: a
// floor for contacts of few pixels, chosen by judgement.
constexpr double kOnePixel = 2;

// Fewer points in the shortest wave than this cannot be halved: a grid carries waves of more than two.
constexpr double kHalvedFrom = 5;

// Contacts of twice (made surfaces) or four times (maps, where a check costs four levels) as many pixels, or of three quarters as many,
// are judged anew. In between a level has the error of the last check, when its contacts were smaller.
constexpr double kGrownMade = 2, kGrownRead = 4, kShrunk = 0.75;

}  // namespace

OtherGrid::OtherGrid(const Job& job, std::int64_t number, int threads, const HeightMap& map, double points_per_wave) {
    if (job.spectrum) {
        Case other = job.settings;
        coarser_ = points_per_wave >= kHalvedFrom;
        other.elements.points_per_wave = (coarser_ ? 0.5 : 2.0) * points_per_wave;
        map_ = make_element_surface(other, number, threads).map;
        map_->x0 = map.x0, map_->y0 = map.y0;
    } else {
        if (static_cast<double>(map.nx) * map.ny > kMostPoints || map.periodic) return;
        map_ = twice_as_fine(map);
    }
    contact_ = make_element_contact(*map_, job.indenter, job.solver);
}

OtherGrid::~OtherGrid() = default;

std::optional<GridError> OtherGrid::error(const LevelValues& level) {
    if (!contact_) return {};
    Level other;
    try {
        other = contact_->at_separation(level.separation);
    } catch (const Error& error) {  // two flats nearer than this grid can be
        if (error.kind() != Failure::bad_input) throw;
        return {};
    }
    if (other.status == LevelStatus::not_converged || level.contacts == 0) return {};
    const double share = coarser_ ? 0.5 : 1.0;
    const auto change = [&](double here, double there) {
        if (here == there) return 0.0;
        return share * std::abs(here - there) / (coarser_ ? here : std::max(here, there));
    };
    // A contact of a few pixels may miss as much on both grids.
    const double few = coarser_ ? kOnePixel * std::pow(level.pixels_per_contact, -1.5) : 0.0;
    return GridError{std::max(few, change(level.force, other.force)), std::max(few, change(level.area, other.area))};
}

void OtherGrid::visit(double separation) {
    if (contact_) (void)contact_->at_separation(separation);
}

ResolutionCheck::ResolutionCheck(const Job& job, std::int64_t number, int threads, const HeightMap& map)
    : job_(job), other_(job, number, threads, map, job.settings.elements.points_per_wave) {}

void ResolutionCheck::judge(std::size_t step, Level& level) {
    if (!other_.exists() || level.status == LevelStatus::not_converged || !(level.force > 0)) return;
    const auto& levels = job_.levels;
    const double grown = job_.spectrum ? kGrownMade : kGrownRead;
    const bool turns = std::isfinite(job_.settings.solids.hardness) && step > 0 && step + 1 < levels.size() &&
                       (levels[step] - levels[step - 1]) * (levels[step + 1] - levels[step]) < 0;
    const bool due = !last_ || level.pixels_per_contact >= grown * pixels_ || level.pixels_per_contact <= kShrunk * pixels_;
    if (due) {
        last_ = other_.error(level);
        pixels_ = level.pixels_per_contact;
    } else if (turns) {
        other_.visit(level.separation);
    }
    if (!last_) return;
    level.force_error_expected = last_->force;
    level.area_error_expected = last_->area;
    if (last_->force > kUnresolved) level.status = graver(level.status, LevelStatus::out_of_validity);
}

}  // namespace rsc
