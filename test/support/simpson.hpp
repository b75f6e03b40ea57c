// Simpson's rule.
#pragma once

// In an even number of steps, which are asked for in the order from `from` to `to`.
template <class F>
double simpson(double from, double to, int steps, F&& f) {
    double sum = 0;
    for (int k = 0; k <= steps; ++k) {
        const int weight = k == 0 || k == steps ? 1 : k % 2 == 1 ? 4 : 2;
        sum += weight * f(from + (to - from) * k / steps);
    }
    return sum * (to - from) / (3 * steps);
}
