#include "trust/doubts.hpp"

#include "base/format.hpp"

namespace rsc {

std::string sentence(Cause cause, bool elements) {
    if (cause == Cause::missed_contact && !elements)
        return "N = 0 is uncertain: the bodies may touch between the modelled summits";
    // In the order of Cause.
    constexpr std::array sentences = {
        "contacts closer to the border of the surface than the mean spacing of its summits: the "
        "surface ends there",
        "the contact may lie on missing points of the map, which are filled smoothly: N is too "
        "small",
        "the contacts have too few pixels: the error of N is above 3 % (with adhesion 10 % of "
        "what presses), or that of A above 10 %",
        "the indenter is steep compared with the surface (slope_ratio above 0.2), so that it "
        "touches flanks, not summits",
        "spots are larger than those for which the contact law and its expected error hold",
        "the summits have too few points, or are spikes one point wide",
        "spots with a radius above a fifth of the thickness of the top layer",
        "the attraction at edges of contact acts across less than four pixels "
        "(cohesive_resolution), or its range is not small beside the roughness that it bridges: N "
        "and the pull-off force may be far off; adhesion_range = 0 needs no range",
        "such surfaces or bodies were not compared with elements, so that no error is stated",
        "N = 0 is uncertain: the bodies may touch between the points of the grid",
        "N may differ from that of elements at this separation by more than 10 %",
        "the steps of sliding may change N, or Z0 under a force, by more than 1 %",
        "body 2 is steep where it touches (rms slope above 0.5): both models assume small slopes, "
        "and nothing that rsc computes says how far N is off"};
    static_assert(sentences.size() == kCauseNames.size());
    return sentences[at(cause)];
}

std::string words_of_doubts(std::int32_t doubts) {
    std::string words;
    for (const auto k : indices(kCauseNames))
        if (doubts & (std::int32_t{1} << k)) enlist(words, ", ", kCauseNames[k]);
    std::replace(words.begin(), words.end(), '_', ' ');
    return words;
}

// What an error of N, relative, adds to that of A: at most the gap between two flats.
static double share_of_area(const LevelValues& level, double force, double pressed) {
    const double f = level.area_fraction,  // NaN: not two flats
        share = std::isnan(pressed) ? force : force * std::abs(level.force) / pressed;
    return f > 0.5 ? std::min(share, (1 - f) / f) : share;
}

void conclude(LevelValues& level, std::span<const Doubt> doubts, bool by_force, double pressed) {
    double force = 0, area = 0, separation = 0;
    level.doubts = 0;
    for (const Doubt& doubt : doubts) {
        force += doubt.force;
        area += doubt.area;
        separation += doubt.separation;
        if (doubt.serious) level.doubts |= bit(doubt.cause);
    }
    level.status = !level.converged              ? LevelStatus::not_converged
                   : level.doubts                ? LevelStatus::out_of_validity
                   : !level.unique               ? LevelStatus::not_unique
                   : level.overlapping_pairs > 0 ? LevelStatus::overlapping
                                                 : LevelStatus::converged;
    const bool known = level.converged && !doubts.empty();
    level.force_error_expected = known && !by_force ? force : kNotComputed;
    level.area_error_expected =
        known ? area + (by_force ? share_of_area(level, force, pressed) : 0.0) : kNotComputed;
    level.separation_error_expected =
        known && by_force && level.stiffness < 0
            ? separation + force * std::abs(level.force) / std::abs(level.stiffness)
            : kNotComputed;
}

}  // namespace rsc
