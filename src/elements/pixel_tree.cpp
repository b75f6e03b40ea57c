// Pixels are grouped in nearly square tiles of 8 columns, and these in boxes of 2 x 2 tiles, 4 x 4
// tiles and so on, where there are pixels.
// Adjacent tiles interact pixel by pixel. Boxes that are not adjacent, but whose parents are,
// interact through q x q Chebyshev points: pressures are interpolated from pixels to the points of
// tiles and of their parents, transferred between boxes, and interpolated back.

#include "base/parallel.hpp"
#include "elements/pixel_interpolation.hpp"
#include "elements/pixel_products.hpp"

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
    // around the bounding rectangle, so that boxes there can be looked up
    static constexpr int kMargin = 3;
    int x0 = 0, y0 = 0, nx = 0, ny = 0;  // bounding rectangle in units of boxes
    // index of the box at each position of the rectangle with its margin, -1: none
    std::vector<int> index;
    std::vector<Box> boxes;
    std::vector<int> parent;          // in the next generation
    std::vector<std::size_t> inside;  // begin of the boxes, or strips of a tile, in each box
    // Pairs of boxes that interact through their points, by chunk of kChunk boxes to which they
    // lead; those of an offset begin at begin[offset].
    struct Pairs {
        std::array<std::size_t, kOffsets + 1> begin{};
        std::vector<std::array<int, 2>> from_to;
    };
    std::vector<Pairs> pairs;

    int find(int x, int y) const { return index[place(x, y)]; }
    int stride() const { return nx + 2 * kMargin; }
    std::size_t place(int x, int y) const {
        return at(y - y0 + kMargin) * at(stride()) + at(x - x0 + kMargin);
    }
    void add(int x, int y) {
        if (find(x, y) < 0) return;
        index[place(x, y)] = static_cast<int>(boxes.size());
        boxes.push_back({x, y});
    }
};

// Positions of the pixels of a set.
struct Layout {
    std::vector<Generation> generations;  // tiles first
    struct Strip {                        // pixels that follow each other in a row of a tile
        std::uint32_t first;
        std::uint8_t count, column, row;  // number of them, place of the first in its tile
    };
    std::vector<Strip> strips;       // sorted by tile
    std::vector<std::size_t> begin;  // of the pixels of each tile, if sorted by tile
    std::vector<std::array<int, 9>>
        around;  // adjacent tiles, row by row, and the tile itself; -1: none
    std::vector<std::array<std::size_t, 2>> chunks;  // generation and chunk of all pairs
    // The first generation whose boxes, with all inside, are work of a thread at a time, and number
    // of chunks of it and those before.
    std::size_t roots = 0, chunks_below = 0;
};

// Sets the rectangle and marks the positions of boxes, which may be given several times and are
// then so once.
void enclose(Generation& g, std::vector<Box>& boxes) {
    int x1 = boxes[0].x, y1 = boxes[0].y;
    g.x0 = x1;
    g.y0 = y1;
    for (const Box& b : boxes) {
        g.x0 = std::min(g.x0, b.x);
        g.y0 = std::min(g.y0, b.y);
        x1 = std::max(x1, b.x);
        y1 = std::max(y1, b.y);
    }
    g.nx = x1 - g.x0 + 1;
    g.ny = y1 - g.y0 + 1;
    g.index.assign(at(g.stride()) * at(g.ny + 2 * Generation::kMargin), -1);
    std::erase_if(boxes,
                  [&](const Box& b) { return std::exchange(g.index[g.place(b.x, b.y)], 0) == 0; });
}

// Finds the pairs of a chunk: boxes that are not adjacent but whose parents are (or that have no
// parents).
void pair_up(Generation& g, std::size_t c) {
    Generation::Pairs& pairs = g.pairs[c];
    pairs.from_to.clear();
    for (int o = 0; o < kOffsets; ++o) {
        const int dx = o % 7 - 3, dy = o / 7 - 3;
        const bool adjacent = std::abs(dx) <= 1 && std::abs(dy) <= 1;
        for (std::size_t k = c * kChunk;
             k < std::min(g.boxes.size(), (c + 1) * kChunk) && !adjacent; ++k) {
            const Box b = g.boxes[k];
            const bool cousins = std::abs(((b.x + dx) >> 1) - (b.x >> 1)) <= 1 &&
                                 std::abs(((b.y + dy) >> 1) - (b.y >> 1)) <= 1;
            if (!cousins && !g.parent.empty()) continue;
            if (const int from = g.find(b.x + dx, b.y + dy); from >= 0)
                pairs.from_to.push_back({from, static_cast<int>(k)});
        }
        pairs.begin[at(o) + 1] = pairs.from_to.size();
    }
}

int threads_for(std::size_t tiles) { return tiles > kThreads ? 0 : 1; }

// The strips of pixels, each within a row of a tile, in the order of the pixels.
struct FoundStrip {
    Box tile;
    Layout::Strip strip;
};
class FoundStrips {
public:
    FoundStrips(const std::vector<Pixel>& pixels, int rows)
        : found_((pixels.size() + kSome - 1) / kSome) {
        const int shift = std::countr_zero(static_cast<unsigned>(rows));
        parallel_for(found_.size(), 1, 0, [&](std::size_t piece) {
            Pixel next{};
            for (std::size_t k = piece * kSome; k < std::min(pixels.size(), (piece + 1) * kSome);
                 ++k) {
                const Pixel p = pixels[k];
                const int column = p.x & (kTileColumns - 1);
                if (k == piece * kSome || column == 0 || p != next)
                    found_[piece].push_back(
                        {{p.x >> kColumnShift, p.y >> shift},
                         {static_cast<std::uint32_t>(k), 0, static_cast<std::uint8_t>(column),
                          static_cast<std::uint8_t>(p.y & (rows - 1))}});
                ++found_[piece].back().strip.count;
                next = {p.x + 1, p.y};
            }
        });
    }

    template <class Visit>
    void for_each(Visit&& visit) const {
        for (const auto& strips : found_)
            for (const FoundStrip& f : strips) visit(f);
    }

    std::vector<Box> tiles() const {
        std::vector<Box> boxes;
        for_each([&](const FoundStrip& f) {
            if (boxes.empty() || f.tile.x != boxes.back().x || f.tile.y != boxes.back().y)
                boxes.push_back(f.tile);
        });
        return boxes;
    }

private:
    static constexpr std::size_t kSome = 8192;  // pixels that a thread takes at a time
    std::vector<std::vector<FoundStrip>> found_;
};

// Sets the generations of boxes above these tiles, and numbers the boxes, from the largest to the
// tiles.
void number_boxes(std::vector<Generation>& generations, std::vector<Box> boxes) {
    std::size_t levels = 0;
    for (;;) {
        if (generations.size() == levels) generations.emplace_back();
        Generation& g = generations[levels++];
        enclose(g, boxes);
        if (g.nx <= 4 && g.ny <= 4) break;
        for (Box& b : boxes) b = {b.x >> 1, b.y >> 1};
    }
    generations.resize(levels);
    Generation& last = generations.back();
    for (int y = 0; y < last.ny; ++y)
        for (int x = 0; x < last.nx; ++x) last.add(last.x0 + x, last.y0 + y);
    for (std::size_t l = levels - 1; l-- > 0;) {
        Generation &g = generations[l], &above = generations[l + 1];
        for (std::size_t k = 0; k < above.boxes.size(); ++k) {
            above.inside.push_back(g.boxes.size());
            for (int child = 0; child < 4; ++child)
                g.add(2 * above.boxes[k].x + child % 2, 2 * above.boxes[k].y + child / 2);
            g.parent.resize(g.boxes.size(), static_cast<int>(k));
        }
        above.inside.push_back(g.boxes.size());
    }
}

// Sorts the strips by tile.
void sort_strips(Layout& layout, const FoundStrips& found) {
    Generation& leaf = layout.generations[0];
    leaf.inside.assign(leaf.boxes.size() + 1, 0);
    layout.begin.assign(leaf.boxes.size() + 1, 0);
    std::size_t strips = 0;
    found.for_each([&](const FoundStrip& f) {
        const std::size_t tile = at(leaf.find(f.tile.x, f.tile.y));
        ++leaf.inside[tile + 1];
        ++strips;
        layout.begin[tile + 1] += f.strip.count;
    });
    for (auto* begin : {&leaf.inside, &layout.begin})
        std::partial_sum(begin->begin(), begin->end(), begin->begin());
    std::vector<std::size_t> next(leaf.inside.begin(), leaf.inside.end() - 1);
    layout.strips.resize(strips);
    found.for_each([&](const FoundStrip& f) {
        layout.strips[next[at(leaf.find(f.tile.x, f.tile.y))]++] = f.strip;
    });
}

// Sets the pairs of boxes that interact, and the neighbours of each tile.
void pair_boxes(Layout& layout) {
    auto& generations = layout.generations;
    const Generation& leaf = generations[0];
    for (std::size_t l = 0; l < generations.size(); ++l) {
        Generation& g = generations[l];
        g.pairs.resize((g.boxes.size() + kChunk - 1) / kChunk);
        for (std::size_t c = 0; c < g.pairs.size(); ++c) layout.chunks.push_back({l, c});
        if (l == 0 || g.boxes.size() >= kFewest) {
            layout.roots = l;
            layout.chunks_below = layout.chunks.size();
        }
    }
    layout.around.resize(leaf.boxes.size());
    parallel_for(layout.chunks.size(), 1, threads_for(leaf.boxes.size()), [&](std::size_t chunk) {
        const auto [l, c] = layout.chunks[chunk];
        pair_up(generations[l], c);
        for (std::size_t t = c * kChunk;
             t < std::min(leaf.boxes.size(), (c + 1) * kChunk) && l == 0; ++t)
            for (int o = 0; o < 9; ++o)
                layout.around[t][at(o)] =
                    leaf.find(leaf.boxes[t].x + o % 3 - 1, leaf.boxes[t].y + o / 3 - 1);
    });
}

// Sets the layout of pixels; its memory is used again.
void lay_out(Layout& layout, const std::vector<Pixel>& pixels, int rows) {
    layout.strips.clear();
    layout.begin.clear();
    layout.chunks.clear();
    for (Generation& g : layout.generations) {
        g.boxes.clear();
        g.parent.clear();
        g.inside.clear();
    }
    layout.roots = layout.chunks_below = 0;
    if (pixels.empty()) return;
    const FoundStrips found(pixels, rows);
    number_boxes(layout.generations, found.tiles());
    sort_strips(layout, found);
    pair_boxes(layout);
}

class Tree final : public PixelProducts {
public:
    Tree(const Substrate& substrate, double dx, double dy, double inner_error, double full_error,
         double shift)
        : answer_{substrate, dx, dy, shift},
          shift_(shift),
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
                    for (int u : {-x, x})
                        near_[at((v + table_.reach_y) * table_.stride + u + table_.reach_x)] =
                            value;
            }
        table_.values = near_.data();
    }

    void set_pixels(const std::vector<Pixel>& pixels) override {
        size_ = pixels.size();
        lay_out(layout_, pixels, rows_);
    }

    void apply(const double* p, double* w, Accuracy accuracy, const char* requested) override {
        ++count_;
        product(layout_, of(accuracy), size_, p, w, requested);
    }

    void elsewhere(const double* p, const std::vector<Pixel>& pixels, double* w,
                   const char* requested) override {
        ++count_;
        if (pixels != others_) {
            others_.clear();  // they do not belong to the layout if an exception ends this
            lay_out(others_layout_, pixels, rows_);
            others_ = pixels;
        }
        product(others_layout_, inner_, pixels.size(), p, w, requested);
    }

    PixelStencil inverse(double diagonal) const override {
        const Substrate& body = answer_.substrate;
        return inverse_stencil(aspect_, with_diagonal(share_of_modes(body, answer_.dx),
                                                      diagonal * body.modulus() / answer_.dx));
    }
    double error(Accuracy accuracy) const override { return of(accuracy).error(); }
    double shift() const override { return shift_; }

private:
    // Number of rows, a power of two, for which a tile is nearly square.
    static int rows_of(double aspect) {
        return 1 << std::clamp(static_cast<int>(std::lround(3 - std::log2(aspect))), 0, 6);
    }

    const Interpolation& of(Accuracy accuracy) const {
        return accuracy == Accuracy::inner     ? inner_
               : accuracy == Accuracy::between ? between_
                                               : full_;
    }
    Interpolation& of(Accuracy accuracy) {
        return const_cast<Interpolation&>(std::as_const(*this).of(accuracy));
    }
    void product(const Layout& layout, Interpolation& interpolation, std::size_t n, const double* p,
                 double* w, const char* requested);

    PixelAnswer answer_;
    double shift_;
    double aspect_;
    int rows_;
    std::vector<double> near_;
    NearTable table_{};
    Interpolation inner_, between_, full_;
    std::size_t size_ = 0;
    std::vector<Pixel> others_;
    Layout layout_, others_layout_;
    // Work space of one product: pressures by tile, points of all boxes.
    std::vector<std::size_t> source_end_;
    std::vector<TileSource> sources_;
    std::vector<std::vector<double>> up_, down_;
    // Boxes with pressures, and with pixels whose deflections are requested.
    enum : char { kLoaded = 1, kRequested = 2 };
    std::vector<std::vector<char>> marks_;

    class Passes;
};

// The passes of one product over the boxes: up from the pixels, transfers between boxes, and down
// to the pixels.
class Tree::Passes {
public:
    Passes(Tree& tree, const Layout& layout, Interpolation& interpolation, std::size_t n,
           const double* p, double* w, const char* requested)
        : tree_(tree),
          layout_(layout),
          generations_(layout.generations),
          leaf_(layout.generations[0]),
          interpolation_(interpolation),
          size_(at(kTileColumns * tree.rows_)),
          points_(at(interpolation.padded())),
          q_(interpolation.points()),
          kernels_(pixel_kernels()),
          p_(p),
          w_(w),
          requested_(requested) {
        const std::size_t levels = generations_.size();
        tree.up_.resize(std::max(tree.up_.size(), levels));
        tree.down_.resize(std::max(tree.down_.size(), levels));
        tree.marks_.resize(std::max(tree.marks_.size(), levels));
        for (std::size_t l = 0; l < levels; ++l) {
            const std::size_t boxes = generations_[l].boxes.size();
            for (auto* values : {&tree.up_[l], &tree.down_[l]})
                if (values->size() < boxes * points_) values->resize(boxes * points_);
            if (tree.marks_[l].size() < boxes) tree.marks_[l].resize(boxes);
            if (levels > 1 || leaf_.boxes.size() > 1) interpolation.matrices(l);
        }
        tree.sources_.resize(n);
        tree.source_end_.resize(leaf_.boxes.size());
    }

    void up_from_pixels(std::size_t t) const {
        const std::size_t begin = layout_.begin[t];
        std::size_t end = begin;
        char mark = requested_ ? 0 : kRequested;
        for (std::size_t i = leaf_.inside[t]; i < leaf_.inside[t + 1]; ++i) {
            const auto [first, count, column, row] = layout_.strips[i];
            for (int c = 0; c < count; ++c) {
                const double value = p_[first + at(c)];
                tree_.sources_[end] = {static_cast<std::int16_t>(column + c), row, value};
                end += value != 0 ? 1 : 0;
                if (requested_)
                    mark = static_cast<char>(mark | (requested_[first + at(c)] ? kRequested : 0));
            }
        }
        tree_.source_end_[t] = end;
        tree_.marks_[0][t] = static_cast<char>(mark | (end > begin ? kLoaded : 0));
        double* const to = tree_.up_[0].data() + t * points_;
        std::fill_n(to, points_, 0.0);
        interpolation_.up_from_tile(end - begin, tree_.sources_.data() + begin, to);
    }
    // From the boxes inside.
    void up(std::size_t l, std::size_t k) const {
        const Generation &g = generations_[l], &below = generations_[l - 1];
        double* const to = tree_.up_[l].data() + k * points_;
        std::fill_n(to, points_, 0.0);
        char& mark = tree_.marks_[l][k] = 0;
        for (std::size_t c = g.inside[k]; c < g.inside[k + 1]; ++c) {
            mark = static_cast<char>(mark | tree_.marks_[l - 1][c]);
            if (!(tree_.marks_[l - 1][c] & kLoaded)) continue;
            interpolation_.up(below.boxes[c].x & 1, below.boxes[c].y & 1,
                              tree_.up_[l - 1].data() + c * points_, to);
        }
    }
    void transfer(const std::array<std::size_t, 2>& chunk) const {
        const auto [l, c] = chunk;
        const Generation::Pairs& pairs = generations_[l].pairs[c];
        const std::vector<char>& marks = tree_.marks_[l];
        const std::size_t first = c * kChunk,
                          last = std::min(first + kChunk, generations_[l].boxes.size());
        std::fill_n(tree_.down_[l].data() + first * points_, (last - first) * points_, 0.0);
        std::array<const double*, kChunk + 1> from;
        std::array<double*, kChunk + 1> to;
        for (std::size_t o = 0; o < kOffsets; ++o) {
            std::size_t count = 0;
            for (std::size_t k = pairs.begin[o]; k < pairs.begin[o + 1]; ++k) {
                const auto [source, target] = pairs.from_to[k];
                from[count] = tree_.up_[l].data() + at(source) * points_;
                to[count] = tree_.down_[l].data() + at(target) * points_;
                count += (marks[at(source)] & kLoaded) && (marks[at(target)] & kRequested) ? 1 : 0;
            }
            if (count > 0)
                kernels_.translate(static_cast<int>(points_), q_ * q_,
                                   interpolation_.matrices(l)[o].data(), count, from.data(),
                                   to.data());
        }
    }
    // From the parent.
    void down(std::size_t l, std::size_t k) const {
        const Generation& g = generations_[l];
        if (!(tree_.marks_[l][k] & kRequested)) return;
        interpolation_.down(g.boxes[k].x & 1, g.boxes[k].y & 1,
                            tree_.down_[l + 1].data() + at(g.parent[k]) * points_,
                            tree_.down_[l].data() + k * points_);
    }
    void down_to_pixels(std::size_t t) const {
        double values[kTileColumns * kMostRows];
        std::fill_n(values, size_, 0.0);
        const bool is_wanted = tree_.marks_[0][t] & kRequested;
        if (is_wanted) interpolation_.down_to_tile(tree_.down_[0].data() + t * points_, values);
        for (int o = 0; o < 9 && is_wanted; ++o) {
            const int s = layout_.around[t][at(o)];
            if (s < 0) continue;
            const std::size_t begin = layout_.begin[at(s)], m = tree_.source_end_[at(s)] - begin;
            if (m > 0)
                kernels_.near_tile(tree_.table_, tree_.rows_, o % 3 - 1, o / 3 - 1, m,
                                   tree_.sources_.data() + begin, values);
        }
        for (std::size_t i = leaf_.inside[t]; i < leaf_.inside[t + 1]; ++i) {
            const auto [first, count, column, row] = layout_.strips[i];
            for (int c = 0; c < count; ++c)
                w_[first + at(c)] = values[row * kTileColumns + column + c];
        }
    }

private:
    Tree& tree_;
    const Layout& layout_;
    const std::vector<Generation>& generations_;
    const Generation& leaf_;
    Interpolation& interpolation_;
    const std::size_t size_, points_;
    const int q_;
    const PixelKernels& kernels_;
    const double* const p_;
    double* const w_;
    const char* const requested_;
};

// The boxes of one generation are pieces of parallel loops with all inside them; those above are a
// piece of the transfers.
void Tree::product(const Layout& layout, Interpolation& interpolation, std::size_t n,
                   const double* p, double* w, const char* requested) {
    if (n == 0) return;
    stopping_point();  // the caller may get no piece of the loops
    const auto& generations = layout.generations;
    const std::size_t levels = generations.size(), roots = layout.roots;
    const int threads = threads_for(generations[0].boxes.size());
    const Passes pass(*this, layout, interpolation, n, p, w, requested);

    // The boxes of each generation inside a root.
    using Ranges = std::array<std::array<std::size_t, 2>, 32>;
    const auto inside = [&](std::size_t root) {
        Ranges ranges;
        ranges[roots] = {root, root + 1};
        for (std::size_t l = roots; l > 0; --l)
            ranges[l - 1] = {generations[l].inside[ranges[l][0]],
                             generations[l].inside[ranges[l][1]]};
        return ranges;
    };
    const std::size_t count = generations[roots].boxes.size();
    parallel_for(count, 1, threads, [&](std::size_t root) {
        const Ranges ranges = inside(root);
        for (std::size_t t = ranges[0][0]; t < ranges[0][1]; ++t) pass.up_from_pixels(t);
        for (std::size_t l = 1; l <= roots; ++l)
            for (std::size_t k = ranges[l][0]; k < ranges[l][1]; ++k) pass.up(l, k);
    });
    parallel_for(1 + layout.chunks_below, 1, threads, [&](std::size_t piece) {
        stopping_point();
        if (piece > 0) return pass.transfer(layout.chunks[piece - 1]);
        for (std::size_t l = roots + 1; l < levels; ++l)
            for (std::size_t k = 0; k < generations[l].boxes.size(); ++k) pass.up(l, k);
        for (std::size_t c = layout.chunks_below; c < layout.chunks.size(); ++c)
            pass.transfer(layout.chunks[c]);
        for (std::size_t l = levels - 1; l-- > roots + 1;)
            for (std::size_t k = 0; k < generations[l].boxes.size(); ++k) pass.down(l, k);
    });
    parallel_for(count, 1, threads, [&](std::size_t root) {
        stopping_point();
        const Ranges ranges = inside(root);
        for (std::size_t l = std::min(roots + 1, levels - 1); l-- > 0;)
            for (std::size_t k = ranges[l][0]; k < ranges[l][1]; ++k) pass.down(l, k);
        for (std::size_t t = ranges[0][0]; t < ranges[0][1]; ++t) pass.down_to_pixels(t);
    });
}

}  // namespace

std::unique_ptr<PixelProducts> make_tree_products(const Substrate& substrate, double dx, double dy,
                                                  double inner_error, double full_error,
                                                  bool shifted) {
    return std::make_unique<Tree>(substrate, dx, dy, inner_error, full_error,
                                  shifted ? substrate.bulge() : 0.0);
}

}  // namespace rsc
