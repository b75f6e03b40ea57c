// Sampled ensembles against closed forms. Seeds are fixed, so the test passes or fails for good; were they drawn anew, each
// comparison would raise a false alarm with the probability of a deviation beyond its threshold: 5 standard deviations of a sum
// of many terms with known variance, 6e-7; 7 of a mean with a variance estimated from 24 surfaces (Student, 23 degrees of
// freedom), 4e-7. In all less than 1e-5 for the whole test.
#include "check.hpp"
#include "contact/asperity_contact.hpp"
#include "rough/detection.hpp"

using namespace rsc;

namespace {

constexpr double kKnown = 5, kEstimated = 7;

// Greenwood and Williamson (1966): M equal summits, heights exponential of mean lambda, pressed by a plane at d without
// interaction. <f> = c lambda^(3/2) Gamma(5/2) e^(-d/lambda), <f^2> = c^2 lambda^3 Gamma(4) e^(-d/lambda); area: Gamma(2),
// Gamma(3).
void exponential_summits() {
    constexpr int M = 20000;
    constexpr double E = 94.0e3, r = 1e-4, lambda = 0.003;
    std::mt19937_64 random(77);
    std::uniform_real_distribution<double> uniform(0, 1);
    std::exponential_distribution<double> height(1 / lambda);
    Asperities a;
    for (int i = 0; i < M; ++i) {
        a.x.push_back(uniform(random)), a.y.push_back(uniform(random)), a.z.push_back(height(random)), a.radius.push_back(r);
    }
    SolverOptions o;
    o.interaction = Interaction::none;
    o.sigma = lambda;
    AsperityContact contact(a, {E, __builtin_huge_val(), 0.5, 0.5}, o);
    const double c = 4.0 / 3.0 * E * std::sqrt(r) * std::pow(lambda, 1.5), s = std::numbers::pi * r * lambda;
    for (double d : {4.0, 2.0, 1.0, 0.2}) {
        const Level level = contact.at_separation(d * lambda);
        const double p = std::exp(-d);
        const auto within = [&](double sum, double mean, double square, const char* what) {
            const double deviation = (sum - M * mean) / std::sqrt(M * (square - mean * mean));
            std::printf("exponential summits, d = %.1f lambda: %s %.3f standard deviations off (%.2f %%)\n", d, what, deviation,
                        100 * (sum / (M * mean) - 1));
            CHECK(std::abs(deviation) < kKnown);
        };
        within(level.force, c * std::tgamma(2.5) * p, c * c * std::tgamma(4) * p, "load");
        within(level.area, s * p, s * s * 2 * p, "area");
        within(static_cast<double>(level.f.size()), p, p, "contacts");
    }
}

// Heights of the summits of isotropic Gaussian surfaces (Nayak 1971; Bush, Gibson and Thomas 1975): mean 4 sqrt(m0/(pi alpha)),
// variance (1 - 0.8968/alpha) m0, number D L^2. Summits to sub-grid accuracy, of surfaces normalised in expectation; bands of
// many modes, so that the fluctuations of m0 are small. `bias` [relative] is what a grid of 16 points in lambda_s may do besides
// chance: it misses 1 % of the summits (0.8 % measured with many more surfaces in test_asperities).
void summit_heights() {
    constexpr int surfaces = 24;
    for (double wide : {4.0, 12.0}) {
        Spectrum spectrum;
        spectrum.L_lambda_l = wide, spectrum.L_lambda_s = 32;
        const Moments m = discrete_moments(spectrum);
        const double alpha = m.nayak();
        std::vector<double> mean, variance, number;
        for (int k = 1; k <= surfaces; ++k) {
            const Asperities a =
                make_asperities(spectrum, 512, Normalise::ensemble, 5, k, Curvature::geometric, nullptr, nullptr, 1, Detail::subgrid);
            double sum = 0, square = 0;
            for (double z : a.z) sum += z, square += z * z;
            const double n = static_cast<double>(a.size());
            mean.push_back(sum / n);
            variance.push_back(square / n - sum / n * sum / n);
            number.push_back(n);
        }
        const auto within = [&](const std::vector<double>& sample, double expected, double bias, const char* what) {
            double sum = 0, square = 0;
            for (double v : sample) sum += v;
            const double average = sum / surfaces;
            for (double v : sample) square += (v - average) * (v - average);
            const double error = std::sqrt(square / (surfaces - 1) / surfaces);
            std::printf("alpha = %.2f: %s %.5g of the closed form, standard error %.1e\n", alpha, what, average / expected,
                        error / expected);
            CHECK_CLOSE(average, expected, kEstimated * error + bias * expected);
            CHECK(error < 0.04 * expected);  // or the comparison says nothing
        };
        within(mean, 4 * std::sqrt(m.m0 / (std::numbers::pi * alpha)), 0.002, "mean summit height");
        within(variance, (1 - 0.8968 / alpha) * m.m0, 0.002, "variance of summit heights");
        within(number, m.summit_density() * spectrum.L * spectrum.L, 0.015, "number of summits");
    }
}

}  // namespace

TESTS {
    exponential_summits();
    summit_heights();
}
