// The ranks of an MPI job as a team. Only rsc_mpi is built with it.
//
// Rank 0 is the program: it reads the case, hands out tasks, adds up the results, writes files and messages. Its own threads work, too.
// The other ranks receive the case, and do tasks until they are dismissed. Only the main thread of a rank calls MPI,
// and it sleeps between looking for messages, so that the processors are left to the threads that compute.
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

    // Rank 0: tells the case to the others and makes a team of all. Threads: of every rank.
    std::unique_ptr<Team> team(Work work, std::size_t threads, const std::string& case_text);
    // Rank 0, at the end: the others leave serve() with this exit status.
    void dismiss(int status);

    // The other ranks: work until dismissed. `make` makes the work out of the case.
    int serve(const std::function<Work(const std::string& case_text, std::size_t threads)>& make);

private:
    int rank_ = 0, size_ = 1;
};

// Threads of a rank: one, unless the case says otherwise.
std::size_t threads_of_rank(int threads);

}  // namespace rsc
