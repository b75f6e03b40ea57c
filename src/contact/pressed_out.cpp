#include "contact/pressed_out.hpp"

#include "error.hpp"

namespace rsc {

PressedOut::PressedOut(int nx, int ny) : nx_(nx), ny_(ny), across_(static_cast<std::size_t>((nx + kSide - 1) / kSide)) {
    squares_.resize(across_ * static_cast<std::size_t>((ny + kSide - 1) / kSide));
}

void PressedOut::add(int i, int j, double depth) {
    auto& square = squares_[square_of(i, j)];
    if (!square) square = std::make_unique<double[]>(kSide * kSide);
    square[place_of(i, j)] += depth;
    sum_ += depth;
}

std::vector<PressedOut::Point> PressedOut::points() const {
    std::vector<Point> points;
    if (none()) return points;
    for (int j = 0; j < ny_; ++j)
        for (int i = 0; i < nx_; i += kSide) {
            if (!squares_[square_of(i, j)]) continue;
            for (int k = i; k < i + kSide && k < nx_; ++k)
                if (const double depth = (*this)(k, j); depth > 0) points.push_back({k, j, depth});
        }
    return points;
}

PressedOut pressed_out_of(const HeightMap& map, const std::vector<double>& triples) {
    PressedOut pressed(map.nx, map.ny);
    for (std::size_t k = 0; k + 2 < triples.size(); k += 3) {
        if (!(triples[k] >= 0 && triples[k] < map.nx && triples[k + 1] >= 0 && triples[k + 1] < map.ny && triples[k + 2] > 0 &&
              triples[k + 2] < 1e50))
            throw Error(Failure::bad_input, "the state does not belong to a contact of this surface");
        pressed.add(static_cast<int>(triples[k]), static_cast<int>(triples[k + 1]), triples[k + 2]);
    }
    return pressed;
}

}  // namespace rsc
