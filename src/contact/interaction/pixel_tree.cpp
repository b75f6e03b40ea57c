// Pixels are grouped in nearly square tiles of 8 columns, and these in boxes of 2 x 2 tiles, 4 x 4 tiles and so on, where there are pixels.
// Adjacent tiles interact pixel by pixel. Boxes that are not adjacent, but whose parents are, interact through q x q Chebyshev points:
// pressures are interpolated from pixels to the points of tiles and of their parents, transferred between boxes, and interpolated back.

#include "contact/interaction/kernel.hpp"
#include "contact/interaction/pixel_kernels.hpp"
#include "contact/interaction/pixel_products.hpp"
#include "rough/parallel.hpp"

namespace rsc {
namespace {

std::size_t at(int k) { return static_cast<std::size_t>(k); }

constexpr int kMostRows = 64;          // rows of a tile, see rows_of()
constexpr int kOffsets = 49;           // offsets between boxes: -3 ... 3 in both directions
constexpr std::size_t kThreads = 500;  // number of boxes above which threads are used
constexpr std::size_t kParts = 8;      // sums of boxes into their parents: each part has an eighth of the parents
constexpr std::size_t kChunk = 128;    // boxes processed by a thread at a time

// Interpolation error with q points, measured in test_pixels.cpp.
double interpolation_error(int q) { return 0.2 * std::pow(6.0, -q); }
constexpr int kMostPoints = 18;
int points_for(double error) {
    int q = 3;
    while (q < kMostPoints && interpolation_error(q) > error) ++q;
    return q;
}

// Chebyshev points of [-1, 1], and the weights for interpolation from them to t.
double chebyshev_point(int q, int i) { return std::cos(std::numbers::pi * (i + 0.5) / q); }
void interpolation_weights(int q, double t, double* weight) {
    for (int i = 0; i < q; ++i) {
        weight[i] = 1;
        for (int j = 0; j < q; ++j) {
            if (j != i) weight[i] *= (t - chebyshev_point(q, j)) / (chebyshev_point(q, i) - chebyshev_point(q, j));
        }
    }
}

struct Box {
    int x, y;
};

// All boxes of one size.
struct Generation {
    int x0 = 0, y0 = 0, nx = 0, ny = 0;  // bounding rectangle in units of boxes
    std::vector<int> index;              // index of the box at each position of the rectangle, -1: none
    std::vector<Box> boxes;              // row by row
    std::vector<int> parent;             // in the next generation
    // Pairs of boxes that interact through their points, by chunk of kChunk boxes to which they lead; those of an offset begin at begin[offset].
    struct Pairs {
        std::array<std::size_t, kOffsets + 1> begin{};
        std::vector<std::array<int, 2>> from_to;
    };
    std::vector<Pairs> pairs;

    int find(int x, int y) const {
        x -= x0, y -= y0;
        return x < 0 || y < 0 || x >= nx || y >= ny ? -1 : index[at(y) * at(nx) + at(x)];
    }
};

// Positions of the pixels of a set.
struct Layout {
    std::vector<Generation> generations;  // tiles first
    std::vector<std::size_t> place;       // of each pixel: tile * (8 rows) + row * 8 + column
    std::vector<std::size_t> in_tiles;    // pixels sorted by tile; those of tile t begin at tile_begin[t]
    std::vector<std::size_t> tile_begin;
};

void enclose(Generation& g, const std::vector<Box>& boxes) {
    int x1 = boxes[0].x, y1 = boxes[0].y;
    g.x0 = x1, g.y0 = y1;
    for (const Box& b : boxes) {
        g.x0 = std::min(g.x0, b.x), g.y0 = std::min(g.y0, b.y);
        x1 = std::max(x1, b.x), y1 = std::max(y1, b.y);
    }
    g.nx = x1 - g.x0 + 1, g.ny = y1 - g.y0 + 1;
    g.index.assign(at(g.nx) * at(g.ny), -1);
    for (const Box& b : boxes) g.index[at(b.y - g.y0) * at(g.nx) + at(b.x - g.x0)] = 0;
    for (int y = 0; y < g.ny; ++y)
        for (int x = 0; x < g.nx; ++x) {
            int& k = g.index[at(y) * at(g.nx) + at(x)];
            if (k < 0) continue;
            k = static_cast<int>(g.boxes.size());
            g.boxes.push_back({g.x0 + x, g.y0 + y});
        }
}

// Finds the pairs of boxes that are not adjacent but whose parents are (or that have no parents).
void pair_up(Generation& g, bool last) {
    g.pairs.resize((g.boxes.size() + kChunk - 1) / kChunk);
    parallel_for(g.pairs.size(), 4, g.boxes.size() > 2 * kThreads ? 0 : 1, [&](std::size_t c) {
        Generation::Pairs& pairs = g.pairs[c];
        for (int o = 0; o < kOffsets; ++o) {
            const int dx = o % 7 - 3, dy = o / 7 - 3;
            for (std::size_t k = c * kChunk; k < std::min(g.boxes.size(), (c + 1) * kChunk); ++k) {
                const Box b = g.boxes[k];
                const bool adjacent = std::abs(dx) <= 1 && std::abs(dy) <= 1;
                const bool cousins = std::abs(((b.x + dx) >> 1) - (b.x >> 1)) <= 1 && std::abs(((b.y + dy) >> 1) - (b.y >> 1)) <= 1;
                if (adjacent || !(cousins || last)) continue;
                if (const int from = g.find(b.x + dx, b.y + dy); from >= 0) pairs.from_to.push_back({from, static_cast<int>(k)});
            }
            pairs.begin[at(o) + 1] = pairs.from_to.size();
        }
    });
}

int floor_divide(int a, int b) { return a >= 0 ? a / b : -((-a + b - 1) / b); }

Layout make_layout(const std::vector<Pixel>& pixels, int rows) {
    Layout layout;
    if (pixels.empty()) return layout;
    std::vector<Box> boxes(pixels.size());
    for (std::size_t k = 0; k < pixels.size(); ++k) boxes[k] = {floor_divide(pixels[k].x, kTileColumns), floor_divide(pixels[k].y, rows)};
    layout.generations.emplace_back();
    enclose(layout.generations[0], boxes);
    layout.place.resize(pixels.size());
    for (std::size_t k = 0; k < pixels.size(); ++k) {
        const int tile = layout.generations[0].find(boxes[k].x, boxes[k].y);
        layout.place[k] = at(tile) * at(kTileColumns * rows) + at((pixels[k].y - boxes[k].y * rows) * kTileColumns) +
                          at(pixels[k].x - boxes[k].x * kTileColumns);
    }
    const std::size_t size = at(kTileColumns * rows);
    layout.tile_begin.assign(layout.generations[0].boxes.size() + 1, 0);
    for (const std::size_t place : layout.place) ++layout.tile_begin[place / size + 1];
    std::partial_sum(layout.tile_begin.begin(), layout.tile_begin.end(), layout.tile_begin.begin());
    std::vector<std::size_t> next(layout.tile_begin.begin(), layout.tile_begin.end() - 1);
    layout.in_tiles.resize(pixels.size());
    for (std::size_t k = 0; k < pixels.size(); ++k) layout.in_tiles[next[layout.place[k] / size]++] = k;
    for (;;) {
        Generation& g = layout.generations.back();
        const bool last = g.nx <= 4 && g.ny <= 4;
        pair_up(g, last);
        if (last) break;
        std::vector<Box> above(g.boxes.size());
        for (std::size_t k = 0; k < above.size(); ++k) above[k] = {g.boxes[k].x >> 1, g.boxes[k].y >> 1};
        Generation next;
        enclose(next, above);
        g.parent.resize(above.size());
        for (std::size_t k = 0; k < above.size(); ++k) g.parent[k] = next.find(above[k].x, above[k].y);
        layout.generations.push_back(std::move(next));
    }
    return layout;
}

// Deflection at an offset from a pixel under unit pressure, with offsets in units of the pixel's first side.
struct PixelAnswer {
    Substrate substrate;
    double dx, dy, shift;
    double operator()(double x, double y) const { return substrate.under_pixel(x * dx, y * dx, dx, dy) + dx * dy * shift; }
};

// Interpolation tables for one number of points, for all layouts.
class Interpolation {
public:
    Interpolation(int q, int rows, const PixelAnswer& answer) : q_(q), rows_(rows), aspect_(answer.dy / answer.dx), answer_(answer) {
        padded_ = (q * q + kLane - 1) / kLane * kLane;
        for (int i = 0; i < q; ++i) point_.push_back(chebyshev_point(q, i));
        columns_of_.resize(at(kTileColumns * q));
        rows_of_.resize(at(rows * q));
        for (int i = 0; i < kTileColumns; ++i) interpolation_weights(q, (i + 0.5) * 2 / kTileColumns - 1, &columns_of_[at(i * q)]);
        for (int i = 0; i < rows; ++i) interpolation_weights(q, (i + 0.5) * 2 / rows - 1, &rows_of_[at(i * q)]);
        for (int half = 0; half < 2; ++half) {
            child_[half].resize(at(q * q));
            for (int i = 0; i < q; ++i)
                interpolation_weights(q, 0.5 * chebyshev_point(q, i) + (half == 0 ? -0.5 : 0.5), &child_[half][at(i * q)]);
        }
    }

    int points() const { return q_; }
    int padded() const { return padded_; }

    // Interpolates pressures on the pixels of a tile to its points: point[j*q + i] = sum rows_of(r, j) columns_of(c, i) value.
    void up_from_tile(std::size_t n, const TileSource* sources, double* point) const {
        for (std::size_t k = 0; k < n; ++k) {
            const double* wx = &columns_of_[at(sources[k].column * q_)];
            const double* wy = &rows_of_[at(sources[k].row * q_)];
            for (int j = 0; j < q_; ++j) {
                const double v = sources[k].value * wy[j];
                for (int i = 0; i < q_; ++i) point[j * q_ + i] += v * wx[i];
            }
        }
    }
    void down_to_tile(const double* point, double* values) const { expand(rows_of_, rows_, columns_of_, kTileColumns, point, values); }
    void up(int half_x, int half_y, const double* child, double* parent) const {
        double part[kMostPoints * kMostPoints];
        const double *cx = child_[half_x].data(), *cy = child_[half_y].data();
        for (int j = 0; j < q_; ++j) {
            double* to = part + j * q_;
            std::fill_n(to, q_, 0.0);
            for (int k = 0; k < q_; ++k)
                for (int i = 0; i < q_; ++i) to[i] += child[j * q_ + k] * cx[k * q_ + i];
        }
        for (int k = 0; k < q_; ++k)
            for (int j = 0; j < q_; ++j)
                for (int i = 0; i < q_; ++i) parent[j * q_ + i] += cy[k * q_ + j] * part[k * q_ + i];
    }
    void down(int half_x, int half_y, const double* parent, double* child) const {
        expand(child_[half_y], q_, child_[half_x], q_, parent, child);
    }

    // Transfer matrices of a generation by offset of the source box, created on first use.
    const std::vector<std::vector<double>>& matrices(std::size_t generation) {
        while (matrices_.size() <= generation) make_matrices();
        return matrices_[generation];
    }

private:
    // Adds to[r*columns + c] the sum of rows_of(r, j) columns_of(c, i) point[j*q + i].
    void expand(const std::vector<double>& rows_of, int rows, const std::vector<double>& columns_of, int columns, const double* point,
                double* to) const {
        double line[kMostPoints];
        for (int r = 0; r < rows; ++r) {
            const double* wy = &rows_of[at(r * q_)];
            std::fill_n(line, q_, 0.0);
            for (int j = 0; j < q_; ++j)
                for (int i = 0; i < q_; ++i) line[i] += wy[j] * point[j * q_ + i];
            for (int c = 0; c < columns; ++c) {
                const double* wx = &columns_of[at(c * q_)];
                double sum = 0;
                for (int i = 0; i < q_; ++i) sum += wx[i] * line[i];
                to[r * columns + c] += sum;
            }
        }
    }

    void make_matrices() {
        const std::size_t generation = matrices_.size();
        const double half_x = 0.5 * kTileColumns * std::ldexp(1.0, static_cast<int>(generation));
        const double half_y = 0.5 * rows_ * aspect_ * std::ldexp(1.0, static_cast<int>(generation));
        matrices_.emplace_back(kOffsets);
        const int n = q_ * q_;
        // Computes the quadrant of positive offsets. The others are mirror images: point i of a line corresponds to point q-1-i.
        for (int oy = 0; oy <= 3; ++oy)
            for (int ox = 0; ox <= 3; ++ox) {
                if (ox <= 1 && oy <= 1) continue;
                std::vector<double> K(at(n) * at(n));  // (target, source)
                for (int t = 0; t < n; ++t)
                    for (int s = 0; s < n; ++s) {
                        const double x = half_x * (2 * ox + point_[at(s % q_)] - point_[at(t % q_)]);
                        const double y = half_y * (2 * oy + point_[at(s / q_)] - point_[at(t / q_)]);
                        K[at(t) * at(n) + at(s)] = answer_(x, y);
                    }
                for (int sy = oy == 0 ? 1 : -1; sy <= 1; sy += 2)
                    for (int sx = ox == 0 ? 1 : -1; sx <= 1; sx += 2) {
                        const auto mirror = [&](int k) {
                            const int i = k % q_, j = k / q_;
                            return at((sy < 0 ? q_ - 1 - j : j) * q_ + (sx < 0 ? q_ - 1 - i : i));
                        };
                        std::vector<double>& T = matrices_.back()[at((sy * oy + 3) * 7 + sx * ox + 3)];
                        T.assign(at(padded_) * at(n), 0.0);
                        std::size_t k = 0;
                        for (int first = 0; first < padded_; first += kSlice) {
                            const int end = std::min(padded_, first + kSlice);
                            for (int s = 0; s < n; ++s)
                                for (int t = first; t < end; ++t, ++k) {
                                    if (t < n) T[k] = K[mirror(t) * at(n) + mirror(s)];
                                }
                        }
                    }
            }
    }

    int q_, rows_, padded_ = 0;
    double aspect_;
    const PixelAnswer& answer_;
    std::vector<double> point_;                 // Chebyshev points
    std::vector<double> columns_of_, rows_of_;  // weights of a tile's columns and rows
    std::vector<double> child_[2];              // weights of the points of the lower and upper half
    std::vector<std::vector<std::vector<double>>> matrices_;
};

class Tree final : public PixelProducts {
public:
    Tree(const Substrate& substrate, double dx, double dy, double inner_error, double full_error, double shift)
        : answer_{substrate, dx, dy, shift},
          aspect_(dy / dx),
          rows_(rows_of(dy / dx)),
          inner_(points_for(inner_error), rows_, answer_),
          between_(points_for(std::sqrt(inner_error * full_error)), rows_, answer_),
          full_(points_for(full_error), rows_, answer_) {
        table_.reach_x = 2 * kTileColumns;
        table_.reach_y = 2 * rows_;
        table_.stride = 2 * table_.reach_x + 1;
        near_.resize(at(table_.stride) * at(2 * table_.reach_y + 1));
        for (int y = 0; y <= table_.reach_y; ++y)
            for (int x = 0; x <= table_.reach_x; ++x) {
                const double value = answer_(x, y * aspect_);
                for (int v : {-y, y})
                    for (int u : {-x, x}) near_[at((v + table_.reach_y) * table_.stride + u + table_.reach_x)] = value;
            }
        table_.values = near_.data();
    }

    void set_pixels(const std::vector<Pixel>& pixels) override {
        pixels_ = pixels;
        layout_ = make_layout(pixels, rows_);
    }

    void apply(const double* p, double* w, Accuracy accuracy) override {
        ++count_;
        product(layout_, of(accuracy), pixels_.size(), p, w);
    }

    void elsewhere(const double* p, const std::vector<Pixel>& where, double* w) override {
        ++count_;
        std::vector<Pixel> all;
        std::vector<double> values, image;
        for (std::size_t k = 0; k < pixels_.size(); ++k) {
            if (p[k] == 0) continue;
            all.push_back(pixels_[k]);
            values.push_back(p[k]);
        }
        const std::size_t sources = all.size();
        all.insert(all.end(), where.begin(), where.end());
        values.resize(all.size(), 0.0);
        image.resize(all.size());
        // A pixel may occur twice, as a source and as a target; its pressures are added.
        product(make_layout(all, rows_), inner_, all.size(), values.data(), image.data());
        std::copy(image.begin() + static_cast<std::ptrdiff_t>(sources), image.end(), w);
    }

    double coefficient(int dx, int dy) const override {
        dx = std::abs(dx), dy = std::abs(dy);
        if (dx <= table_.reach_x && dy <= table_.reach_y) return near_[at((dy + table_.reach_y) * table_.stride + dx + table_.reach_x)];
        return answer_(dx, dy * aspect_);
    }

    double error(Accuracy accuracy) const override { return interpolation_error(of(accuracy).points()); }

private:
    // Number of rows, a power of two, for which a tile is nearly square.
    static int rows_of(double aspect) { return 1 << std::clamp(static_cast<int>(std::lround(3 - std::log2(aspect))), 0, 6); }

    const Interpolation& of(Accuracy accuracy) const {
        return accuracy == Accuracy::inner ? inner_ : accuracy == Accuracy::between ? between_ : full_;
    }
    Interpolation& of(Accuracy accuracy) { return const_cast<Interpolation&>(std::as_const(*this).of(accuracy)); }
    void product(const Layout& layout, Interpolation& interpolation, std::size_t n, const double* p, double* w);

    PixelAnswer answer_;
    double aspect_;
    int rows_;
    std::vector<double> near_;
    NearTable table_{};
    Interpolation inner_, between_, full_;
    std::vector<Pixel> pixels_;
    Layout layout_;
    // Work space of one product: pressures by tile, points of all boxes.
    std::vector<std::size_t> source_end_;
    std::vector<TileSource> sources_;
    std::vector<std::vector<double>> up_, down_;
    std::vector<std::vector<char>> loaded_;
};

void Tree::product(const Layout& layout, Interpolation& interpolation, std::size_t n, const double* p, double* w) {
    if (n == 0) return;
    const auto& generations = layout.generations;
    const Generation& leaf = generations[0];
    const std::size_t tiles = leaf.boxes.size(), size = at(kTileColumns * rows_), points = at(interpolation.padded());
    const int q = interpolation.points();

    const std::size_t levels = generations.size();
    up_.resize(std::max(up_.size(), levels));
    down_.resize(std::max(down_.size(), levels));
    loaded_.resize(std::max(loaded_.size(), levels));
    for (std::size_t l = 0; l < levels; ++l) {
        up_[l].resize(generations[l].boxes.size() * points);
        down_[l].resize(generations[l].boxes.size() * points);
        if (l > 0) std::fill(up_[l].begin(), up_[l].end(), 0.0);
        loaded_[l].assign(generations[l].boxes.size(), 0);
        if (levels > 1 || leaf.boxes.size() > 1) interpolation.matrices(l);
    }
    // A product has parallel loops over the tiles, over the boxes of each size, over transfers between boxes of all sizes, and back.
    const int threads = tiles > kThreads ? 0 : 1;
    sources_.resize(n);
    source_end_.resize(tiles);
    parallel_for(tiles, 32, threads, [&](std::size_t t) {
        const std::size_t begin = layout.tile_begin[t];
        std::size_t end = begin;
        for (std::size_t i = begin; i < layout.tile_begin[t + 1]; ++i) {
            const std::size_t k = layout.in_tiles[i], at_place = layout.place[k] % size;
            if (p[k] != 0)
                sources_[end++] = {static_cast<std::int16_t>(at_place % kTileColumns), static_cast<std::int16_t>(at_place / kTileColumns),
                                   p[k]};
        }
        source_end_[t] = end;
        loaded_[0][t] = end > begin;
        double* const to = up_[0].data() + t * points;
        std::fill_n(to, points, 0.0);
        interpolation.up_from_tile(end - begin, sources_.data() + begin, to);
    });
    const auto threads_for = [&](const Generation& g) { return g.boxes.size() > kThreads ? threads : 1; };
    for (std::size_t l = 0; l + 1 < levels; ++l) {
        // A part of the parents at a time, each with its children in their order.
        const Generation& g = generations[l];
        const std::size_t parents = generations[l + 1].boxes.size(), parts = threads_for(g) == 1 ? 1 : kParts;
        parallel_for(parts, 1, threads_for(g), [&](std::size_t part) {
            const std::size_t first = parents * part / parts, last = parents * (part + 1) / parts;
            for (std::size_t k = 0; k < g.boxes.size(); ++k) {
                const auto parent = at(g.parent[k]);
                if (parent < first || parent >= last || !loaded_[l][k]) continue;
                loaded_[l + 1][parent] = 1;
                interpolation.up(g.boxes[k].x & 1, g.boxes[k].y & 1, up_[l].data() + k * points, up_[l + 1].data() + parent * points);
            }
        });
    }
    const PixelKernels& kernels = pixel_kernels();
    std::vector<std::pair<std::size_t, std::size_t>> chunks;  // generation, chunk
    for (std::size_t l = 0; l < levels; ++l)
        for (std::size_t c = 0; c < generations[l].pairs.size(); ++c) chunks.emplace_back(l, c);
    parallel_for(chunks.size(), 1, threads, [&](std::size_t job) {
        stopping_point();
        const std::size_t l = chunks[job].first, c = chunks[job].second;
        const Generation::Pairs& pairs = generations[l].pairs[c];
        const std::size_t first = c * kChunk * points, last = std::min((c + 1) * kChunk * points, down_[l].size());
        std::fill(down_[l].begin() + static_cast<std::ptrdiff_t>(first), down_[l].begin() + static_cast<std::ptrdiff_t>(last), 0.0);
        std::vector<const double*> from;
        std::vector<double*> to;
        for (std::size_t o = 0; o < kOffsets; ++o) {
            from.clear();
            to.clear();
            for (std::size_t k = pairs.begin[o]; k < pairs.begin[o + 1]; ++k) {
                const auto [source, target] = pairs.from_to[k];
                if (!loaded_[l][at(source)]) continue;
                from.push_back(up_[l].data() + at(source) * points);
                to.push_back(down_[l].data() + at(target) * points);
            }
            if (!from.empty())
                kernels.translate(static_cast<int>(points), q * q, interpolation.matrices(l)[o].data(), from.size(), from.data(),
                                  to.data());
        }
    });
    const auto down = [&](std::size_t l, std::size_t k) {
        const Generation& g = generations[l];
        interpolation.down(g.boxes[k].x & 1, g.boxes[k].y & 1, down_[l + 1].data() + at(g.parent[k]) * points,
                           down_[l].data() + k * points);
    };
    for (std::size_t l = levels - 1; l-- > 1;)
        parallel_for(generations[l].boxes.size(), 32, threads_for(generations[l]), [&](std::size_t k) { down(l, k); });
    parallel_for(tiles, 32, threads, [&](std::size_t t) {
        stopping_point();
        if (levels > 1) down(0, t);
        double values[kTileColumns * kMostRows];
        std::fill_n(values, size, 0.0);
        interpolation.down_to_tile(down_[0].data() + t * points, values);
        const Box b = leaf.boxes[t];
        for (int oy = -1; oy <= 1; ++oy)
            for (int ox = -1; ox <= 1; ++ox) {
                const int s = leaf.find(b.x + ox, b.y + oy);
                if (s < 0) continue;
                const std::size_t begin = layout.tile_begin[at(s)], m = source_end_[at(s)] - begin;
                if (m > 0) kernels.near_tile(table_, rows_, ox, oy, m, sources_.data() + begin, values);
            }
        for (std::size_t i = layout.tile_begin[t]; i < layout.tile_begin[t + 1]; ++i) {
            const std::size_t pixel = layout.in_tiles[i];
            w[pixel] = values[layout.place[pixel] % size];
        }
    });
}

}  // namespace

std::unique_ptr<PixelProducts> make_tree_products(const Substrate& substrate, double dx, double dy, double inner_error, double full_error,
                                                  bool shifted) {
    return std::make_unique<Tree>(substrate, dx, dy, inner_error, full_error, shifted ? substrate.bulge() : 0.0);
}

}  // namespace rsc
