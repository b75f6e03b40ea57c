// The ranks of an MPI job as a team. Only rsc_mpi is built with it.
//
// Rank 0 reads the case, distributes tasks, adds up the results, and writes files and messages; its
// own threads also compute.
// The other ranks receive the case and process tasks until they are dismissed. Only the main thread
// of a rank calls MPI, and it sleeps between checks for messages, so that the processors are
// available to the computing threads.
#pragma once

#include "run/team.hpp"

namespace rsc {

class MpiJob {
public:
    MpiJob(int& argc, char**& argv);  // MPI_Init
    MpiJob(const MpiJob&) = delete;
    MpiJob& operator=(const MpiJob&) = delete;
    ~MpiJob();  // MPI_Finalize
    bool root() const { return rank_ == 0; }
    int size() const { return size_; }

    // Rank 0: sends the case to the other ranks and forms a team of all. `threads`: of every rank.
    std::unique_ptr<Team> team(Work work, std::size_t threads, const std::string& case_text);
    // Rank 0, at the end: the other ranks return from serve() with this exit status.
    void dismiss(int status);

    // The other ranks: process tasks until dismissed. `make` creates the work from the case.
    int serve(const std::function<Work(const std::string& case_text, std::size_t threads)>& make);

private:
    int rank_ = 0, size_ = 1;
};

// Threads of a rank: one, unless the case specifies more.
std::size_t threads_of_rank(int threads);

}  // namespace rsc
