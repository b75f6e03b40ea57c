// The contents of a result file in memory: R realizations x S levels of one case.
#pragma once

#include "case/case.hpp"
#include "observe/fields.hpp"
#include "observe/record.hpp"
#include "surface/measured.hpp"
#include "surface/surface.hpp"

namespace rsc {

// The rectangle of the surface.
struct Domain {
    double x0 = 0, y0 = 0, Lx = 0, Ly = 0;  // [length]
};

// The contacts of the levels one after the other; level s has contacts start[s] ... start[s] +
// count[s] - 1, numbered from 0 here and from 1 in the file.
struct PackedContacts {
    std::vector<std::int32_t> start, count;  // [step]; empty: contacts are not stored
    std::vector<std::int32_t> asperity;      // index of the asperity, from 0; elements: empty
    std::vector<double> x, y;  // centroid of the contact's pressure; asperities: empty
    std::vector<double> force, radius;
    std::vector<double> spot_x, spot_y, major, minor,
        angle;                         // ellipses (Level::spots); other laws and elements: empty
    std::vector<std::int32_t> yields;  // 1 if the contact yields; empty if none ever does
};

// The numbers of each contact, in the order of the file.
struct ContactColumn {
    const char* name;
    std::vector<double> PackedContacts::*of;
    int length_power, force_power;  // both 0: an angle
    const char *meaning, *comment = "";
};
inline constexpr ContactColumn kContactColumns[] = {
    {"x", &PackedContacts::x, 1, 0, "x of the centroid of the contact's pressure"},
    {"y", &PackedContacts::y, 1, 0, "y of the centroid of the contact's pressure",
     "a contact is a set of pixels connected by their sides"},
    {"force", &PackedContacts::force, 0, 1, "force of the contact, f"},
    {"radius", &PackedContacts::radius, 1, 0, "radius of the contact, a",
     "its area is pi a^2: of an ellipse, the root of the product of its semi-axes"},
    {"spot_x", &PackedContacts::spot_x, 1, 0, "x of the middle of the contact's elliptic spot",
     "a contact within the spot of another has that spot; the contact area is the area of the "
     "union of all spots"},
    {"spot_y", &PackedContacts::spot_y, 1, 0, "y of the middle of the contact's elliptic spot"},
    {"major", &PackedContacts::major, 1, 0, "major semi-axis of the contact's elliptic spot"},
    {"minor", &PackedContacts::minor, 1, 0, "minor semi-axis of the contact's elliptic spot"},
    {"angle", &PackedContacts::angle, 0, 0, "direction of the major semi-axis, from x"}};

// A level of the asperity model solved also by elements (&compare). NaN: not known, or the elements
// did not converge.
struct ComparedLevel {
    std::int32_t step = 0;  // the level, from 0
    // Of elements:
    double separation = 0, force = 0, area = 0, area_pixels = 0, residual = 0;
    double force_error_expected = kNotComputed, area_error_expected = kNotComputed;
    std::int32_t contacts = 0, columns = 0, rows = 0;  // columns and rows of their grid
    // Asperities over elements - 1; that of the force is NaN under force control.
    double force_error = kNotComputed, area_error = kNotComputed, contacts_error = kNotComputed;
    // asperities minus elements, under force control [length]
    double separation_error = kNotComputed;
};
struct ComparedLevels {
    std::vector<ComparedLevel> levels;
    LevelPixels pixels;  // of the last one
    long failed = 0;     // levels at which elements did not converge
};

struct Result {
    Case settings;
    std::string case_text;
    Indenter indenter;
    double sigma = kNotComputed;    // unit of length of separations
    std::optional<Moments> theory;  // closed forms; synthetic surfaces have them
    Observations observations;
    // Of one realization only:
    Asperities asperities;  // empty: not written
    std::vector<double>
        residual_depth;                // of each asperity after the last level; empty: not written
    ResidualProfile residual_profile;  // of elements after the last level; empty: not written
    PackedContacts contacts;           // empty: not written
    std::vector<LevelPixels> pixels;   // [step], elements; empty where they are not written
    std::shared_ptr<const HeightMap> heights;  // null: not written
    Fields fields;                             // empty: not written
    std::shared_ptr<const Measured> measured;  // of a measured map; null: not written
    ComparedLevels compared;                   // empty: not written

    // The separation of a level differs between realizations.
    bool force_control() const { return settings.indentation.control != Control::separation; }
};

// output%contacts, with `automatic` resolved: all for one realization, none for more.
// Throws Error(bad_input) if the case requests contacts or heights of several realizations.
Contacts contacts_kept(const Case& c);

// sqrt_m4 determines the ranges of the distributions: sqrt(m4) in theory for a synthetic surface,
// of the grid for a measured one, and typical_sqrt_m4(asperities) for asperities given without a
// surface.
ObserveOptions observe_options(const Case& c, const Domain& domain, const Indenter& indenter,
                               double sigma, double sqrt_m4);

// 0.9 over the mean radius: inverts <1/kappa_g> = 0.900/sqrt(m4) of isotropic Gaussian surfaces
// [1/length].
double typical_sqrt_m4(const Asperities& asperities);

Result make_result(const Case& c, std::string case_text, const Indenter& indenter, double sigma,
                   std::optional<Moments> theory, Observations observations);

// Packs the contacts of all levels, of the last one only, or of no level, and takes their pixels.
void keep_contacts(Result& result, std::vector<Level>& levels, Contacts keep);

// The moments for drawing the regimes: the closed forms, otherwise the means of m2 and m4 over the
// realizations; NaN if there are none.
Moments regime_moments(const Result& result);

// Reads the sums over realizations from the result file of a campaign, so that realizations can be
// added: the sums at the time of writing, within rounding. `options` and `steps` are those of the
// case. Throws Error(bad_input) with the name of the file if it lacks the sums (it has one
// realization, or is of an earlier version), has other bins, map or levels, or is damaged.
Accumulators read_sums(const std::string& path, const ObserveOptions& options, std::size_t steps);

// Levels of all realizations in a result, and how many of them did not converge. None if the file
// lacks them.
struct LevelCount {
    long levels = 0, failed = 0;
};
std::optional<LevelCount> count_levels(const std::string& path);

}  // namespace rsc
