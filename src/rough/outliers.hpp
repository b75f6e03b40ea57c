// Outliers of a measured map: single points or small groups of points far from their neighbours, caused by dust or lost light.
#pragma once

#include "rough/surface.hpp"

namespace rsc {

struct Outliers {
    long count = 0;
    double threshold = 0;  // [length]
};

// Sets outliers to NaN. An outlier differs from the median of the 5 x 5 points around it by more than `times` the standard deviation of
// these differences, estimated robustly as 1.4826 times their median. Missing points and neighbours are ignored.
Outliers remove_outliers(HeightMap& map, double times);

}  // namespace rsc
