#include "trust/resolution.hpp"

#include "base/error.hpp"
#include "elements/element_contact.hpp"
#include "surface/summits.hpp"
#include "surface/surface.hpp"
#include "trust/expected_error.hpp"

namespace rsc {
namespace {

// Expected error of N for contacts of one pixel, on synthetic surfaces and on maps, assumed to
// decrease as the third power of the contact radius in pixels: an empirical lower bound for
// contacts of few pixels.
constexpr double kOnePixel = 2, kOnePixelRead = 0.7;
double of_pixels(double pixels, bool read) {
    return (read ? kOnePixelRead : kOnePixel) * std::pow(pixels, -1.5);
}

// Fitted to 180 levels of random surfaces and shapes against 40 points in the shortest wave
// (test/README, elements): share of the change to a finer grid, what is added for contacts of a few
// pixels, and for the area.
constexpr double kFiner = 1.5, kOnePixelFiner = 0.1, kPixelArea = 0.5;

// Elements, sharp punches on a plane: N differs from 2 a E* d by up to this share of the ratio of
// pixel side to radius, in nine of ten cases.
constexpr double kEdgeShare = 0.17;

// Fewer points in the shortest wavelength than this cannot be halved, because a grid resolves
// wavelengths of more than two points.
constexpr double kHalvedFrom = 5;

// Two flats: changes of N with the grid are several times larger than this tolerance, and are
// needed to one digit.
constexpr double kTolerance = 2e-5;

// Errors of N and A on ridges, fitted to 150 ridged bodies (test/README). If all crests rose above
// the points as far as they can, N would grow by a share q. The error of N is 0.35 q where contacts
// are wide (small q), and three times as much just after first touch (large q). That of A is 0.8
// sqrt(q): the width of a contact in points is proportional to 1/sqrt(q).
constexpr double kCrest = 0.35, kCrestArea = 0.8;

// A map needs as many points a side for its half.
constexpr int kFewestPoints = 16;

// The check is repeated when contacts have twice as many pixels, or three quarters as many. In
// between, levels keep the error of the last check, whose contacts were smaller.
constexpr double kGrown = 2, kShrunk = 0.75;

double edge_share(const Job& job, double side) {
    const double edge = job.indenter.shape->edge(side);
    return edge > 0 ? kEdgeShare * side / edge : 0;
}

}  // namespace

OtherGrid::OtherGrid(const Job& job, std::int64_t number, int threads, const HeightMap& map,
                     double points_per_wave)
    : read_(!job.spectrum),
      by_force_(relaxes(job.settings) && job.settings.indentation.control != Control::separation) {
    edge_ = edge_share(job, std::max(map.dx, map.dy));
    if (job.settings.solids.adhesion > 0)
        // its error is that of cohesive_resolution (physics/adhesion/adhesive_elements.cpp)
        return;
    // Points of the map itself on its grid of half as many points, if there is one. Two flats need
    // the rows in memory.
    const auto half = [&] {
        return job.indenter.period.finite() ? every_second_point_of(map).copy()
                                            : every_second_point_of(map);
    };
    coarser_ = read_ || points_per_wave >= kHalvedFrom;
    if (read_) {
        if (std::min(map.nx, map.ny) < kFewestPoints ||
            (map.periodic && (map.nx % 2 != 0 || map.ny % 2 != 0)))
            return;
        map_ = half();
    } else if (coarser_ && map.nx % 2 == 0 && map.ny % 2 == 0) {
        map_ = half();
    } else {
        Case other = job.settings;
        other.elements.points_per_wave = (coarser_ ? 0.5 : 2.0) * points_per_wave;
        map_ = make_element_surface(other, number, threads, &job.indenter, job.levels).map;
        map_->x0 = map.x0, map_->y0 = map.y0;
    }
    SolverOptions options = job.solver;
    if (job.indenter.period.finite()) options.tolerance = std::max(options.tolerance, kTolerance);
    contact_ = make_element_contact(*map_, job.indenter, options);
}

OtherGrid::~OtherGrid() = default;

std::optional<GridError> OtherGrid::error(const LevelValues& level) {
    if (!contact_) return {};
    if (contact_->relaxes()) contact_->set_time(level.time);
    Level other;
    try {
        other = by_force_ && level.force > 0 ? contact_->at_force(level.force)
                                             : contact_->at_separation(level.separation);
    } catch (const Error& error) {  // two flats closer than this grid allows
        if (error.kind() != Failure::bad_input) throw;
        return {};
    }
    if (other.status == LevelStatus::not_converged || level.contacts == 0) return {};
    if (by_force_)
        other.force += contact_->stiffness() *
                       (level.separation - other.separation);  // at the separation of the level
    const double share = coarser_ ? 0.5 : kFiner, pixels = level.pixels_per_contact;
    const auto change = [&](double here, double there) {
        return here == there
                   ? 0.0
                   : share * std::abs(here - there) / (coarser_ ? here : std::max(here, there));
    };
    const double force = change(level.force, other.force), area = change(level.area, other.area);
    // Fitted to maps solved on a grid of half the step (test/README, elements on maps): nine of ten
    // are within these bounds.
    if (read_)
        return GridError{edge_ + force + 0.04 * area + of_pixels(pixels, true),
                         edge_ + 1.4 * area + 2 * force + std::pow(pixels, -0.75)};
    // Contacts of a few pixels may have the same error on both grids, and their areas in whole
    // pixels by chance.
    const double few = coarser_ ? of_pixels(pixels, false) : kOnePixelFiner / pixels;
    return GridError{edge_ + (coarser_ ? std::max(few, force) : few + force),
                     edge_ + std::max(few, area) + kPixelArea * std::pow(pixels, -0.75)};
}

void OtherGrid::visit(double separation) {
    if (contact_) (void)contact_->at_separation(separation);
}

Crests::Crests(const Job& job, const HeightMap& map) : map_(map), indenter_(job.indenter) {
    if (!job.spectrum) return;
    const Moments m = theoretical_moments(*job.spectrum);
    bend_ = {m.tensor.m20 / m.m0, m.tensor.m11 / m.m0, m.tensor.m02 / m.m0};
}

// Height of a crest above points half a step beside it, as far as it is longer than wide: (k1 - k2)
// h^2/8 of the curvatures at a point. On synthetic surfaces, of which not all heights need be kept,
// the curvatures are those to be expected at its height.
double Crests::height(int column, int row) const {
    const bool synthetic = bend_.xx + bend_.yy > 0, repeats = indenter_.period.finite();
    double z[3][3];
    for (int b = 0; b < 3; ++b)
        for (int a = 0; a < 3; ++a) {
            const int i = continued(column + a - 1, map_.nx, repeats),
                      j = continued(row + b - 1, map_.ny, repeats);
            z[b][a] = indenter_.clearance(map_.x0 + i * map_.dx, map_.y0 + j * map_.dy,
                                          synthetic ? 0.0 : map_(i, j));
        }
    // Beyond the edge of the indenter, which lies somewhere between two points, the face is as
    // steep as if it rose to half-way between.
    for (int b = 0; b < 3; ++b)
        for (int a = 0; a < 3; ++a)
            if (const double opposite = z[2 - b][2 - a]; !std::isfinite(z[b][a]))
                z[b][a] = std::isfinite(opposite) ? 3 * opposite - 2 * z[1][1] : z[1][1];
    PointDifferences d = differences(z[0], z[1], z[2], 0, 1, 2);
    const double top = synthetic ? map_(column, row) : 0.0;
    d.zxx -= top * bend_.xx * map_.dx * map_.dx, d.zxy -= top * bend_.xy * map_.dx * map_.dy,
        d.zyy -= top * bend_.yy * map_.dy * map_.dy;
    const double sum = -(d.zxx + d.zyy), difference = std::hypot(d.zxx - d.zyy, 2 * d.zxy);
    const double ridge = std::min(difference, 0.5 * (sum + difference)) / 8;
    return ridge > 0 && std::isfinite(ridge) ? ridge : 0.0;
}

GridError Crests::error(const Level& level) const {
    double mean = 0;
    for (std::size_t c = 0; c < level.f.size(); ++c)
        mean += level.f[c] / level.force *
                height(level.asperity[c] % map_.nx, level.asperity[c] / map_.nx);
    const double share = mean * -level.stiffness / level.force;
    return share > 0 ? GridError{kCrest * share * (1 + 2 * share / (1 + share)),
                                 kCrestArea * std::sqrt(share)}
                     : GridError{};
}

ResolutionCheck::ResolutionCheck(const Job& job, std::int64_t number, int threads,
                                 const HeightMap& map)
    : job_(job), other_(job, number, threads, map, job.settings.elements.points_per_wave) {}

void ResolutionCheck::judge(std::size_t step, Level& level, const Crests& ridges) {
    const bool relaxing = relaxes(
        job_.settings);  // every level depends on all before it, also on those without contact
    if (!other_.exists() || level.status == LevelStatus::not_converged ||
        !(level.force > 0 || relaxing))
        return;
    const auto& levels = job_.levels;
    const bool turns = std::isfinite(job_.settings.solids.hardness) && step > 0 &&
                       step + 1 < levels.size() &&
                       (levels[step] - levels[step - 1]) * (levels[step + 1] - levels[step]) <= 0;
    const bool due = relaxing || !last_ || level.pixels_per_contact >= kGrown * pixels_ ||
                     level.pixels_per_contact <= kShrunk * pixels_;
    if (due) {
        last_ = other_.error(level);
        pixels_ = level.pixels_per_contact;
    } else if (turns) {
        other_.visit(level.separation);
    }
    if (!last_) return;
    const GridError crests = ridges.error(level);
    level.force_error_expected = std::max(last_->force, crests.force);
    level.area_error_expected = std::max(last_->area, crests.area);
    if (level.force_error_expected > kUnresolved)
        level.status = graver(level.status, LevelStatus::out_of_validity);
}

void judge_pixels(Level& level, const Job& job, double side, const Crests& ridges) {
    const Adhesion& adhesion = job.solver.adhesion;
    const double pulled =
        adhesion.work > 0 ? adhesion.work / adhesion.range * (level.area + level.cohesive_area) : 0;
    if (level.status == LevelStatus::not_converged || level.contacts == 0 ||
        !(level.force + pulled > 0) || level.force == 0)
        return;
    const bool read = !job.spectrum;
    // The error of the force that presses; with adhesion N is its difference from the attraction,
    // and has that of the attraction already.
    // A contact that the border cuts off has an edge there like that of a punch.
    const double cut = level.edge_contacts > 0
                           ? kEdgeShare * std::sqrt(std::numbers::pi / level.pixels_per_contact)
                           : 0;
    const GridError crests = adhesion.work > 0 ? GridError{} : ridges.error(level);
    const double error = std::max(of_pixels(level.pixels_per_contact, read), crests.force) +
                         edge_share(job, side) + cut;
    level.force_error_expected = error * (level.force + pulled) / std::abs(level.force) +
                                 (pulled > 0 ? level.force_error_expected : 0);
    level.area_error_expected =
        std::max(error + (read ? 1 : kPixelArea) * std::pow(level.pixels_per_contact, -0.75),
                 crests.area) +
        (pulled > 0 ? level.area_error_expected : 0);
    if (level.force_error_expected > (pulled > 0 ? kMuchError : kUnresolved))
        level.status = graver(level.status, LevelStatus::out_of_validity);
}

bool FilledPoints::at(double x, double y) const {
    const auto nearest = [&](double from, double step, int n) {
        const int k = static_cast<int>(std::lround(from / step));
        return periodic ? wrapped(k, n) : k;
    };
    const int i = nearest(x - x0, dx, nx), j = nearest(y - y0, dy, ny);
    return i >= 0 && j >= 0 && i < nx && j < ny && (*filled)[index(i, j)];
}

std::vector<FilledPoints> filled_points(const Job& job, const Measured* m) {
    std::vector<FilledPoints> maps;
    if (m && !m->filled.empty())
        maps.push_back({{m->nx, m->ny, m->dx, m->dy, job.domain.x0, job.domain.y0},
                        &m->filled,
                        job.indenter.period.finite(),
                        false});
    if (const ShapeKeys& body = job.indenter.shape->keys(); !body.filled.empty()) {
        const HeightMap& m = *body.map;
        const double x0 = job.indenter.x0 - 0.5 * (m.nx - 1) * m.dx,
                     y0 = job.indenter.y0 - 0.5 * (m.ny - 1) * m.dy;
        maps.push_back({{m.nx, m.ny, m.dx, m.dy, x0, y0}, &body.filled, m.periodic, true});
    }
    return maps;
}

namespace {

// Share of the filled points in the area where the heights reach the indenter, for Gaussian heights
// of rms sigma. The points in a hole of body
// 2, whose face is smooth there, count like the others in their cell.
double expected_share(double Z0, std::span<const FilledPoints> maps, const Indenter& indenter,
                      double sigma) {
    struct Cell {
        double points = 0, reached = 0;  // outside the holes of body 2
        double filled = 0;               // part of `reached` in those of body 1
        double missing = 0,
               // points in holes of body 2, and their part of the area that is reached as they are
            smooth = 0;
    };
    const FilledPoints& grid = maps.front();
    const int side = indenter.period.finite() ? 1 : 8;  // cells along a side; two flats: one
    std::vector<Cell> cells(static_cast<std::size_t>(side) * static_cast<std::size_t>(side));
    constexpr int most = 128;  // points along a side, enough for a share
    const int step_x = (grid.nx + most - 1) / most, step_y = (grid.ny + most - 1) / most;
    for (int j = 0; j < grid.ny; j += step_y)
        for (int i = 0; i < grid.nx; i += step_x) {
            Cell& cell =
                cells[static_cast<std::size_t>(j * side / grid.ny * side + i * side / grid.nx)];
            const double x = grid.x(i), y = grid.y(j);
            const double reached =
                std::erfc((Z0 - indenter.clearance(x, y, 0)) / (std::numbers::sqrt2 * sigma));
            const auto in = [&](bool second) {
                return std::any_of(maps.begin(), maps.end(), [&](const auto& map) {
                    return map.second == second && map.at(x, y);
                });
            };
            if (in(true)) {
                cell.missing += 1, cell.smooth += reached;
            } else {
                cell.points += 1, cell.reached += reached;
                if (in(false)) cell.filled += reached;
            }
        }
    double filled = 0, all = 0;
    for (const Cell& c : cells) {
        const double there =
            std::max(c.points > 0 ? c.reached * c.missing / c.points : 0.0, c.smooth);
        filled += c.filled + there, all += c.reached + there;
    }
    return all > 0 ? filled / all : 0;
}

}  // namespace

void judge_filled(Level& level, std::span<const FilledPoints> maps, const Indenter& indenter,
                  double sigma) {
    if (maps.empty()) return;
    double filled = 0, all = 0;
    const auto count = [&](double x, double y) {
        all += 1;
        filled += std::any_of(maps.begin(), maps.end(),
                              [&](const FilledPoints& map) { return map.at(x, y); });
    };
    const LevelPixels& pixels = level.pixels;
    for (std::size_t k = 0; k < pixels.index.size(); ++k) count(pixels.x(k), pixels.y(k));
    const FilledPoints& grid = maps.front();
    for (std::size_t c = 0; c < level.a.size() && pixels.index.empty(); ++c) {
        const double x = level.x[c] - grid.x0, y = level.y[c] - grid.y0, a = level.a[c];
        const auto first = [&](double from) {
            return grid.periodic ? std::ceil(from) : std::max(std::ceil(from), 0.0);
        };
        const auto last = [&](double to, int n) {
            return grid.periodic ? to : std::min(to, n - 1.0);
        };
        for (double j = first((y - a) / grid.dy); j <= last((y + a) / grid.dy, grid.ny); ++j)
            for (double i = first((x - a) / grid.dx); i <= last((x + a) / grid.dx, grid.nx); ++i)
                if (std::hypot(i * grid.dx - x, j * grid.dy - y) <= a)
                    count(grid.x0 + i * grid.dx, grid.y0 + j * grid.dy);
    }
    level.filled_share = std::max(all > 0 ? filled / all : 0.0,
                                  expected_share(level.separation, maps, indenter, sigma));
    if (level.filled_share > kMuchFilled)
        level.status = graver(level.status, LevelStatus::out_of_validity);
}

}  // namespace rsc
