#include "contact/lapack.hpp"

#include "error.hpp"

extern "C" {
void dgesv_(const int* n, const int* nrhs, double* a, const int* lda, int* ipiv, double* b, const int* ldb, int* info);
void dpotrf_(const char* uplo, const int* n, double* a, const int* lda, int* info, std::size_t uplo_length);
void dstev_(const char* jobz, const int* n, double* d, double* e, double* z, const int* ldz, double* work, int* info,
            std::size_t jobz_length);
}

namespace rsc::lapack {

bool solve(int n, double* A, double* b, std::vector<int>& pivots) {
    pivots.resize(static_cast<std::size_t>(n));
    const int one = 1;
    int info = 0;
    dgesv_(&n, &one, A, &n, pivots.data(), b, &n, &info);
    if (info < 0) throw Error(Failure::internal, "dgesv refused argument " + std::to_string(-info));
    return info == 0;
}

bool is_positive_definite(int n, double* A) {
    int info = 0;
    dpotrf_("L", &n, A, &n, &info, 1);
    return info == 0;
}

double lowest_of_tridiagonal(std::vector<double> alpha, std::vector<double> beta, std::vector<double>& vector) {
    const int n = static_cast<int>(alpha.size());
    beta.resize(alpha.size());
    std::vector<double> z(alpha.size() * alpha.size()), work(2 * alpha.size());
    int info = 0;
    dstev_("V", &n, alpha.data(), beta.data(), z.data(), &n, work.data(), &info, 1);
    if (info != 0) throw Error(Failure::internal, "dstev did not converge");
    vector.assign(z.begin(), z.begin() + n);
    return alpha.front();
}

}  // namespace rsc::lapack
