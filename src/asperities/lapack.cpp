#include "asperities/lapack.hpp"

#include <sys/mman.h>
#include <sys/resource.h>

#include "base/error.hpp"

extern "C" {
void dgesv_(const int* n, const int* nrhs, double* a, const int* lda, int* ipiv, double* b,
            const int* ldb, int* info);
void dpotrf_(const char* uplo, const int* n, double* a, const int* lda, int* info,
             std::size_t uplo_length);
void dstev_(const char* jobz, const int* n, double* d, double* e, double* z, const int* ldz,
            double* work, int* info, std::size_t jobz_length);
}

namespace rsc::lapack {
namespace {

// True if the system refuses allocations beyond its limits, instead of ending the process when the
// memory is used.
bool memory_is_limited() {
    for (const auto what : {RLIMIT_AS, RLIMIT_DATA}) {
        rlimit limit{};
        if (getrlimit(what, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY) return true;
    }
    int overcommit = 0;
    std::ifstream("/proc/sys/vm/overcommit_memory") >> overcommit;
    return overcommit == 2;
}

// OpenBLAS keeps a buffer of 128 MiB for each concurrent call, and retries forever if the
// allocation fails (version 0.3.21). If memory is limited, calls are therefore made one at a time,
// and the first only if there is enough memory.
class Turn {
public:
    Turn() {
        static const bool limited = memory_is_limited();
        if (!limited) return;
        static std::mutex mutex;
        turn_ = std::unique_lock(mutex);
        static bool taken = false;
        if (taken) return;
        constexpr std::size_t room = std::size_t{160} << 20;  // includes a margin for other threads
        void* const there =
            mmap(nullptr, room, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
        if (there == MAP_FAILED) throw std::bad_alloc();
        munmap(there, room);
        taken = true;
    }

private:
    std::unique_lock<std::mutex> turn_;
};

// Lowest eigenvalue and its unit eigenvector of the symmetric tridiagonal matrix with the diagonal
// alpha and off-diagonal beta.
double lowest_of_tridiagonal(std::vector<double> alpha, std::vector<double> beta,
                             std::vector<double>& vector) {
    const int n = int(alpha.size());
    beta.resize(alpha.size());
    std::vector<double> z(alpha.size() * alpha.size()), work(2 * alpha.size());
    int info = 0;
    dstev_("V", &n, alpha.data(), beta.data(), z.data(), &n, work.data(), &info, 1);
    if (info != 0) throw Error(Failure::internal, "dstev did not converge");
    vector.assign(z.begin(), z.begin() + n);
    return alpha.front();
}

}  // namespace

bool solve(int n, double* A, double* b, std::vector<int>& pivots) {
    pivots.resize(at(n));
    const int one = 1;
    int info = 0;
    const Turn turn;
    dgesv_(&n, &one, A, &n, pivots.data(), b, &n, &info);
    if (info < 0)
        throw Error(Failure::internal, "dgesv rejected argument " + std::to_string(-info));
    return info == 0;
}

bool is_positive_definite(int n, double* A) {
    int info = 0;
    const Turn turn;
    dpotrf_("L", &n, A, &n, &info, 1);
    return info == 0;
}

double lanczos_lowest(
    std::size_t n,
    const std::function<void(const std::vector<double>&, std::vector<double>&)>& multiply,
    std::vector<double>& vector) {
    const std::size_t most = std::min<std::size_t>(n, 300);
    std::vector<std::vector<double>> basis;
    std::vector<double> alpha, beta, image(n), ritz;
    std::vector<double> q(n);
    // A fixed start vector that is not orthogonal to any eigenvector by symmetry.
    for (const auto k : indices(n)) q[k] = std::sin(12.9898 * double(k + 1)) + 0.1;
    double length = std::sqrt(dot(q, q)), lowest = 1;
    while (basis.size() < most) {
        for (double& x : q) x /= length;
        basis.push_back(q);
        multiply(q, image);
        alpha.push_back(dot(q, image));
        // Three-term recurrence, after which reorthogonalisation only removes rounding errors.
        for (const auto k : indices(n)) image[k] -= alpha.back() * q[k];
        if (basis.size() > 1) {
            const auto& before = basis[basis.size() - 2];
            for (const auto k : indices(n)) image[k] -= beta.back() * before[k];
        }
        for (const auto& b : basis) {
            const double c = dot(b, image);
            for (const auto k : indices(n)) image[k] -= c * b[k];
        }
        q = image;
        length = std::sqrt(dot(q, q));
        const std::size_t m = basis.size();
        const bool last = m == most || length < 1e-12;
        if (last || m % 5 == 0) {
            lowest = lowest_of_tridiagonal(alpha, beta, ritz);
            const double error = last && length < 1e-12 ? 0.0 : length * std::abs(ritz.back());
            if (last || error < 0.2 * std::abs(lowest)) {
                if (lowest > 0) lowest -= std::min(error, 0.99 * lowest);
                break;
            }
        }
        beta.push_back(length);
    }
    vector.assign(n, 0.0);
    for (const auto m : indices(ritz)) {
        for (const auto k : indices(n)) vector[k] += ritz[m] * basis[m][k];
    }
    return lowest;
}

}  // namespace rsc::lapack
