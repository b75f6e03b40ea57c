// Pixels are grouped in nearly square tiles of 8 columns, and these in boxes of 2 x 2 tiles, 4 x 4 tiles and so on, where there are pixels.
// Adjacent tiles interact pixel by pixel. Boxes that are not adjacent, but whose parents are, interact through q x q Chebyshev points:
// pressures are interpolated from pixels to the points of tiles and of their parents, transferred between boxes, and interpolated back.

#include "contact/interaction/pixel_interpolation.hpp"
#include "contact/interaction/pixel_products.hpp"
#include "rough/parallel.hpp"

namespace rsc {
namespace {

constexpr int kColumnShift = std::countr_zero(unsigned{kTileColumns});
constexpr std::size_t kThreads = 200;  // number of tiles above which threads are used
constexpr std::size_t kChunk = 128;    // boxes to which a thread transfers at a time
constexpr std::size_t kFewest = 64;    // boxes of the generation whose parts are work of a thread

struct Box {
    int x, y;
};

// All boxes of one size. Those of a parent follow each other, in the order of the parents.
struct Generation {
    int x0 = 0, y0 = 0, nx = 0, ny = 0;  // bounding rectangle in units of boxes
    std::vector<int> index;              // index of the box at each position of the rectangle, -1: none
    std::vector<Box> boxes;
    std::vector<int> parent;          // in the next generation
    std::vector<std::size_t> inside;  // begin of the boxes, or pixels of a tile, in each box
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
    void add(int x, int y) {
        if (find(x, y) < 0) return;
        index[at(y - y0) * at(nx) + at(x - x0)] = static_cast<int>(boxes.size());
        boxes.push_back({x, y});
    }
};

// Positions of the pixels of a set.
struct Layout {
    std::vector<Generation> generations;  // tiles first
    struct Member {
        std::uint32_t pixel;
        std::uint16_t column, row;  // in its tile
    };
    std::vector<Member> in_tiles;                    // pixels sorted by tile
    std::vector<std::array<std::size_t, 2>> chunks;  // generation and chunk of all pairs
    // The first generation whose boxes, with all inside, are work of a thread at a time, and number of chunks of it and those before.
    std::size_t roots = 0, chunks_below = 0;
};

// Sets the rectangle and marks the positions of boxes, which may be given several times and are then so once.
void enclose(Generation& g, std::vector<Box>& boxes) {
    int x1 = boxes[0].x, y1 = boxes[0].y;
    g.x0 = x1, g.y0 = y1;
    for (const Box& b : boxes) {
        g.x0 = std::min(g.x0, b.x), g.y0 = std::min(g.y0, b.y);
        x1 = std::max(x1, b.x), y1 = std::max(y1, b.y);
    }
    g.nx = x1 - g.x0 + 1, g.ny = y1 - g.y0 + 1;
    g.index.assign(at(g.nx) * at(g.ny), -1);
    std::erase_if(boxes, [&](const Box& b) { return std::exchange(g.index[at(b.y - g.y0) * at(g.nx) + at(b.x - g.x0)], 0) == 0; });
}

// Finds the pairs of a chunk: boxes that are not adjacent but whose parents are (or that have no parents).
void pair_up(Generation& g, std::size_t c) {
    Generation::Pairs& pairs = g.pairs[c];
    for (int o = 0; o < kOffsets; ++o) {
        const int dx = o % 7 - 3, dy = o / 7 - 3;
        for (std::size_t k = c * kChunk; k < std::min(g.boxes.size(), (c + 1) * kChunk); ++k) {
            const Box b = g.boxes[k];
            const bool adjacent = std::abs(dx) <= 1 && std::abs(dy) <= 1;
            const bool cousins = std::abs(((b.x + dx) >> 1) - (b.x >> 1)) <= 1 && std::abs(((b.y + dy) >> 1) - (b.y >> 1)) <= 1;
            if (adjacent || !(cousins || g.parent.empty())) continue;
            if (const int from = g.find(b.x + dx, b.y + dy); from >= 0) pairs.from_to.push_back({from, static_cast<int>(k)});
        }
        pairs.begin[at(o) + 1] = pairs.from_to.size();
    }
}

int threads_for(std::size_t tiles) { return tiles > kThreads ? 0 : 1; }

Layout make_layout(const std::vector<Pixel>& pixels, int rows) {
    Layout layout;
    if (pixels.empty()) return layout;
    // Calls visit(k, box, is_new) with the position of the tile of pixel k, and whether it is another than that of the pixel before.
    const int shift = std::countr_zero(static_cast<unsigned>(rows));
    const auto for_tiles = [&](auto&& visit) {
        Box last{};
        for (std::size_t k = 0; k < pixels.size(); ++k) {
            const Box b{pixels[k].x >> kColumnShift, pixels[k].y >> shift};
            visit(k, b, k == 0 || b.x != last.x || b.y != last.y);
            last = b;
        }
    };
    auto& generations = layout.generations;
    std::vector<Box> boxes;
    for_tiles([&](std::size_t, const Box& b, bool is_new) {
        if (is_new) boxes.push_back(b);
    });
    for (;;) {
        const Generation& g = generations.emplace_back();
        enclose(generations.back(), boxes);
        if (g.nx <= 4 && g.ny <= 4) break;
        for (Box& b : boxes) b = {b.x >> 1, b.y >> 1};
    }
    // Numbers the boxes, from the largest to the tiles.
    Generation& last = generations.back();
    for (int y = 0; y < last.ny; ++y)
        for (int x = 0; x < last.nx; ++x) last.add(last.x0 + x, last.y0 + y);
    for (std::size_t l = generations.size() - 1; l-- > 0;) {
        Generation &g = generations[l], &above = generations[l + 1];
        for (std::size_t k = 0; k < above.boxes.size(); ++k) {
            above.inside.push_back(g.boxes.size());
            for (int child = 0; child < 4; ++child) g.add(2 * above.boxes[k].x + child % 2, 2 * above.boxes[k].y + child / 2);
            g.parent.resize(g.boxes.size(), static_cast<int>(k));
        }
        above.inside.push_back(g.boxes.size());
    }
    Generation& leaf = generations[0];
    leaf.inside.assign(leaf.boxes.size() + 1, 0);
    std::size_t tile = 0;
    for_tiles([&](std::size_t, const Box& b, bool is_new) {
        if (is_new) tile = at(leaf.find(b.x, b.y));
        ++leaf.inside[tile + 1];
    });
    std::partial_sum(leaf.inside.begin(), leaf.inside.end(), leaf.inside.begin());
    std::vector<std::size_t> next(leaf.inside.begin(), leaf.inside.end() - 1);
    layout.in_tiles.resize(pixels.size());
    for_tiles([&](std::size_t k, const Box& b, bool is_new) {
        if (is_new) tile = at(leaf.find(b.x, b.y));
        layout.in_tiles[next[tile]++] = {static_cast<std::uint32_t>(k), static_cast<std::uint16_t>(pixels[k].x & (kTileColumns - 1)),
                                         static_cast<std::uint16_t>(pixels[k].y & (rows - 1))};
    });
    for (std::size_t l = 0; l < generations.size(); ++l) {
        Generation& g = generations[l];
        g.pairs.resize((g.boxes.size() + kChunk - 1) / kChunk);
        for (std::size_t c = 0; c < g.pairs.size(); ++c) layout.chunks.push_back({l, c});
        if (l == 0 || g.boxes.size() >= kFewest) layout.roots = l, layout.chunks_below = layout.chunks.size();
    }
    parallel_for(layout.chunks.size(), 1, threads_for(leaf.boxes.size()),
                 [&](std::size_t c) { pair_up(generations[layout.chunks[c][0]], layout.chunks[c][1]); });
    return layout;
}

class Tree final : public PixelProducts {
public:
    Tree(const Substrate& substrate, double dx, double dy, double inner_error, double full_error, double shift)
        : answer_{substrate, dx, dy, shift},
          aspect_(dy / dx),
          rows_(rows_of(dy / dx)),
          inner_(inner_error, rows_, answer_),
          between_(std::sqrt(inner_error * full_error), rows_, answer_),
          full_(full_error, rows_, answer_) {
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

    void elsewhere(const double* p, const std::vector<Pixel>& pixels, double* w) override {
        ++count_;
        if (pixels != others_) {
            others_.clear();  // they do not belong to the layout if an exception ends this
            others_layout_ = make_layout(pixels, rows_);
            others_ = pixels;
        }
        product(others_layout_, inner_, pixels.size(), p, w);
    }

    double coefficient(int dx, int dy) const override {
        dx = std::abs(dx), dy = std::abs(dy);
        if (dx <= table_.reach_x && dy <= table_.reach_y) return near_[at((dy + table_.reach_y) * table_.stride + dx + table_.reach_x)];
        return answer_(dx, dy * aspect_);
    }

    double error(Accuracy accuracy) const override { return of(accuracy).error(); }

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
    std::vector<Pixel> pixels_, others_;
    Layout layout_, others_layout_;
    // Work space of one product: pressures by tile, points of all boxes.
    std::vector<std::size_t> source_end_;
    std::vector<TileSource> sources_;
    std::vector<std::vector<double>> up_, down_;
    std::vector<std::vector<char>> loaded_;
};

// Up from the pixels, transfers between boxes, and down to the pixels. The boxes of one generation are pieces of parallel loops with all inside
// them; those above are a piece of the transfers.
void Tree::product(const Layout& layout, Interpolation& interpolation, std::size_t n, const double* p, double* w) {
    if (n == 0) return;
    stopping_point();  // the caller may get no piece of the loops
    const auto& generations = layout.generations;
    const Generation& leaf = generations[0];
    const std::size_t levels = generations.size(), roots = layout.roots, size = at(kTileColumns * rows_),
                      points = at(interpolation.padded());
    const int q = interpolation.points(), threads = threads_for(leaf.boxes.size());

    up_.resize(std::max(up_.size(), levels));
    down_.resize(std::max(down_.size(), levels));
    loaded_.resize(std::max(loaded_.size(), levels));
    for (std::size_t l = 0; l < levels; ++l) {
        up_[l].resize(generations[l].boxes.size() * points);
        down_[l].resize(generations[l].boxes.size() * points);
        loaded_[l].resize(generations[l].boxes.size());
        if (levels > 1 || leaf.boxes.size() > 1) interpolation.matrices(l);
    }
    sources_.resize(n);
    source_end_.resize(leaf.boxes.size());
    const auto up_from_pixels = [&](std::size_t t) {
        std::size_t end = leaf.inside[t];
        for (std::size_t i = end; i < leaf.inside[t + 1]; ++i) {
            const auto [k, column, row] = layout.in_tiles[i];
            if (p[k] != 0) sources_[end++] = {static_cast<std::int16_t>(column), static_cast<std::int16_t>(row), p[k]};
        }
        source_end_[t] = end;
        loaded_[0][t] = end > leaf.inside[t];
        double* const to = up_[0].data() + t * points;
        std::fill_n(to, points, 0.0);
        interpolation.up_from_tile(end - leaf.inside[t], sources_.data() + leaf.inside[t], to);
    };
    const auto up = [&](std::size_t l, std::size_t k) {  // from the boxes inside
        const Generation &g = generations[l], &below = generations[l - 1];
        double* const to = up_[l].data() + k * points;
        std::fill_n(to, points, 0.0);
        loaded_[l][k] = 0;
        for (std::size_t c = g.inside[k]; c < g.inside[k + 1]; ++c) {
            if (!loaded_[l - 1][c]) continue;
            loaded_[l][k] = 1;
            interpolation.up(below.boxes[c].x & 1, below.boxes[c].y & 1, up_[l - 1].data() + c * points, to);
        }
    };
    const PixelKernels& kernels = pixel_kernels();
    const auto transfer = [&](const std::array<std::size_t, 2>& chunk) {
        const auto [l, c] = chunk;
        const Generation::Pairs& pairs = generations[l].pairs[c];
        const std::size_t first = c * kChunk * points, last = std::min((c + 1) * kChunk * points, down_[l].size());
        std::fill(down_[l].begin() + static_cast<std::ptrdiff_t>(first), down_[l].begin() + static_cast<std::ptrdiff_t>(last), 0.0);
        std::array<const double*, kChunk> from;
        std::array<double*, kChunk> to;
        for (std::size_t o = 0; o < kOffsets; ++o) {
            std::size_t count = 0;
            for (std::size_t k = pairs.begin[o]; k < pairs.begin[o + 1]; ++k) {
                const auto [source, target] = pairs.from_to[k];
                if (!loaded_[l][at(source)]) continue;
                from[count] = up_[l].data() + at(source) * points;
                to[count++] = down_[l].data() + at(target) * points;
            }
            if (count > 0)
                kernels.translate(static_cast<int>(points), q * q, interpolation.matrices(l)[o].data(), count, from.data(), to.data());
        }
    };
    const auto down = [&](std::size_t l, std::size_t k) {  // from the parent
        const Generation& g = generations[l];
        interpolation.down(g.boxes[k].x & 1, g.boxes[k].y & 1, down_[l + 1].data() + at(g.parent[k]) * points,
                           down_[l].data() + k * points);
    };
    const auto down_to_pixels = [&](std::size_t t) {
        double values[kTileColumns * kMostRows];
        std::fill_n(values, size, 0.0);
        interpolation.down_to_tile(down_[0].data() + t * points, values);
        const Box b = leaf.boxes[t];
        for (int oy = -1; oy <= 1; ++oy)
            for (int ox = -1; ox <= 1; ++ox) {
                const int s = leaf.find(b.x + ox, b.y + oy);
                if (s < 0) continue;
                const std::size_t begin = leaf.inside[at(s)], m = source_end_[at(s)] - begin;
                if (m > 0) kernels.near_tile(table_, rows_, ox, oy, m, sources_.data() + begin, values);
            }
        for (std::size_t i = leaf.inside[t]; i < leaf.inside[t + 1]; ++i) {
            const auto [k, column, row] = layout.in_tiles[i];
            w[k] = values[row * kTileColumns + column];
        }
    };

    // The boxes of each generation inside a root.
    using Ranges = std::array<std::array<std::size_t, 2>, 32>;
    const auto inside = [&](std::size_t root) {
        Ranges ranges;
        ranges[roots] = {root, root + 1};
        for (std::size_t l = roots; l > 0; --l) ranges[l - 1] = {generations[l].inside[ranges[l][0]], generations[l].inside[ranges[l][1]]};
        return ranges;
    };
    const std::size_t count = generations[roots].boxes.size();
    parallel_for(count, 1, threads, [&](std::size_t root) {
        const Ranges ranges = inside(root);
        for (std::size_t t = ranges[0][0]; t < ranges[0][1]; ++t) up_from_pixels(t);
        for (std::size_t l = 1; l <= roots; ++l)
            for (std::size_t k = ranges[l][0]; k < ranges[l][1]; ++k) up(l, k);
    });
    parallel_for(1 + layout.chunks_below, 1, threads, [&](std::size_t piece) {
        stopping_point();
        if (piece > 0) return transfer(layout.chunks[piece - 1]);
        for (std::size_t l = roots + 1; l < levels; ++l)
            for (std::size_t k = 0; k < generations[l].boxes.size(); ++k) up(l, k);
        for (std::size_t c = layout.chunks_below; c < layout.chunks.size(); ++c) transfer(layout.chunks[c]);
        for (std::size_t l = levels - 1; l-- > roots + 1;)
            for (std::size_t k = 0; k < generations[l].boxes.size(); ++k) down(l, k);
    });
    parallel_for(count, 1, threads, [&](std::size_t root) {
        stopping_point();
        const Ranges ranges = inside(root);
        for (std::size_t l = std::min(roots + 1, levels - 1); l-- > 0;)
            for (std::size_t k = ranges[l][0]; k < ranges[l][1]; ++k) down(l, k);
        for (std::size_t t = ranges[0][0]; t < ranges[0][1]; ++t) down_to_pixels(t);
    });
}

}  // namespace

std::unique_ptr<PixelProducts> make_tree_products(const Substrate& substrate, double dx, double dy, double inner_error, double full_error,
                                                  bool shifted) {
    return std::make_unique<Tree>(substrate, dx, dy, inner_error, full_error, shifted ? substrate.bulge() : 0.0);
}

}  // namespace rsc
