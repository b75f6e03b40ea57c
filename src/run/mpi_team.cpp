// Compiled with RSC_MPI for rsc_mpi; empty otherwise.
#ifdef RSC_MPI

#include "run/mpi_team.hpp"

#include <mpi.h>

#include "base/archive.hpp"
#include "run/signals.hpp"

namespace rsc {
namespace {

using namespace std::chrono_literals;

enum Tag : int { kCase = 1, kTask, kStop, kAnswer, kError, kSignal };

struct Message {
    int rank = 0, tag = 0;
    std::string bytes;
};

std::optional<Message> receive() {
    int there = 0;
    MPI_Status status;
    MPI_Iprobe(MPI_ANY_SOURCE, MPI_ANY_TAG, MPI_COMM_WORLD, &there, &status);
    if (!there) return {};
    int length = 0;
    MPI_Get_count(&status, MPI_BYTE, &length);
    Message message{status.MPI_SOURCE, status.MPI_TAG, std::string(at(length), '\0')};
    MPI_Recv(message.bytes.data(), length, MPI_BYTE, message.rank, message.tag, MPI_COMM_WORLD,
             MPI_STATUS_IGNORE);
    return message;
}

// Messages being sent; their bytes are stored until delivery.
class Outbox {
public:
    void send(int rank, Tag tag, std::string bytes) {
        if (bytes.size() > at(std::numeric_limits<int>::max()))
            throw Error(
                Failure::internal,
                "a result of more than 2 GiB cannot be sent by MPI; use fewer map_cells or levels");
        Letter& letter = letters_.emplace_back(Letter{std::move(bytes), MPI_REQUEST_NULL});
        MPI_Isend(letter.bytes.data(), int(letter.bytes.size()), MPI_BYTE, rank, tag,
                  MPI_COMM_WORLD, &letter.request);
    }
    void tidy() {
        for (int arrived = 1; !letters_.empty();) {
            MPI_Test(&letters_.front().request, &arrived, MPI_STATUS_IGNORE);
            if (!arrived) return;
            letters_.pop_front();
        }
    }
    // The receivers check for messages until all ranks have left.
    ~Outbox() {
        for (Letter& letter : letters_) MPI_Wait(&letter.request, MPI_STATUS_IGNORE);
    }

private:
    struct Letter {
        std::string bytes;
        MPI_Request request;
    };
    std::deque<Letter> letters_;
};

// The value at the beginning of a message.
template <class T>
T first_of(std::string_view bytes) {
    return from_bytes<T>(bytes.substr(0, sizeof(T)));
}

// Results that are no longer needed must still be received until all ranks have left, because their
// senders wait for it.
void leave_together() {
    MPI_Request left = MPI_REQUEST_NULL;
    MPI_Ibarrier(MPI_COMM_WORLD, &left);
    for (int all = 0; !all; MPI_Test(&left, &all, MPI_STATUS_IGNORE))
        if (!receive()) std::this_thread::sleep_for(1ms);
}

// An exception as kind and text, and back.
std::string packed(const std::exception_ptr& error) {
    try {
        std::rethrow_exception(error);
    } catch (const Error& e) {
        return bytes_of(std::int32_t(e.kind())) + e.what();
    } catch (const std::bad_alloc&) {
        return bytes_of(std::int32_t(Failure::no_memory)) + "out of memory";
    } catch (const std::exception& e) {
        return bytes_of(std::int32_t(Failure::internal)) + e.what();
    }
}

[[noreturn]] void rethrow(const Message& message) {
    throw Error(static_cast<Failure>(first_of<std::int32_t>(message.bytes)), "rank ", message.rank,
                ": ", message.bytes.substr(std::min(message.bytes.size(), sizeof(std::int32_t))));
}

class MpiTeam : public Team {
public:
    MpiTeam(Work work, std::size_t threads, int ranks)
        : work_(std::move(work)), threads_(threads), ranks_(at(ranks)) {}

    std::size_t workers() const override { return threads_ * ranks_; }

    void run(const Next& next, const Collect& collect, int ahead) override {
        leave_if_interrupted();
        WorkerThreads local(work_, threads_);
        std::vector<std::size_t> at_work(ranks_, 0);
        const auto wait =
            ahead > 0
                ? 2ms
                : 10ms;  // between checks for messages: a realization takes less time than a member
        for (;;) {
            const std::size_t unfinished = hand_out(next, local, at_work, ahead);
            if (unfinished == 0) return;
            std::optional<WorkerThreads::Done> done = local.pop(ranks_ > 1 ? wait : 50ms);
            leave_if_interrupted();
            if (done) {
                --at_work[0];
                if (done->error) std::rethrow_exception(done->error);
                collect(done->task, std::move(done->answer));
            }
            while (std::optional<Message> message = receive()) {
                if (message->tag == kError) rethrow(*message);
                if (message->tag == kSignal) note_signal(first_of<std::int32_t>(message->bytes));
                leave_if_interrupted();
                if (message->tag != kAnswer) continue;
                --at_work[at(message->rank)];
                collect(first_of<Task>(message->bytes), message->bytes.substr(sizeof(Task)));
            }
            outbox_.tidy();
        }
    }

private:
    // Distributes one task to every worker before a second one. Returns the number of unfinished
    // tasks.
    std::size_t hand_out(const Next& next, WorkerThreads& local, std::vector<std::size_t>& at_work,
                         int ahead) {
        bool more = true;
        for (std::size_t deep = 1; more && deep <= at(1 + ahead); ++deep)
            for (std::size_t rank = 0; more && rank < ranks_; ++rank)
                while (more && at_work[rank] < deep * threads_) {
                    const std::optional<Task> task = next();
                    more = task.has_value();
                    if (!more) break;
                    ++at_work[rank];
                    if (rank == 0)
                        local.push(*task);
                    else
                        outbox_.send(int(rank), kTask, bytes_of(*task));
                }
        std::size_t sum = 0;
        for (std::size_t n : at_work) sum += n;
        return sum;
    }

    Work work_;
    std::size_t threads_, ranks_;
    Outbox outbox_;
};

}  // namespace

std::size_t threads_of_rank(int threads) { return threads > 0 ? at(threads) : 1; }

MpiJob::MpiJob(int& argc, char**& argv) {
    int provided = 0;
    MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &provided);
    MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
    MPI_Comm_size(MPI_COMM_WORLD, &size_);
    if (provided >= MPI_THREAD_FUNNELED) return;
    MPI_Finalize();
    throw Error(Failure::internal, "this MPI library does not support programs with threads");
}

MpiJob::~MpiJob() { MPI_Finalize(); }

std::unique_ptr<Team> MpiJob::team(Work work, std::size_t threads, const std::string& case_text) {
    const std::string text = bytes_of(std::uint64_t(threads)) + case_text;
    for (int rank = 1; rank < size_; ++rank)
        MPI_Send(text.data(), int(text.size()), MPI_BYTE, rank, kCase, MPI_COMM_WORLD);
    return std::make_unique<MpiTeam>(std::move(work), threads, size_);
}

void MpiJob::dismiss(int status) {
    const auto value = std::int32_t(status);
    for (int rank = 1; rank < size_; ++rank)
        MPI_Send(&value, sizeof value, MPI_BYTE, rank, kStop, MPI_COMM_WORLD);
    leave_together();
}

int MpiJob::serve(const std::function<Work(const std::string&, std::size_t)>& make) {
    int status = 1;
    {
        Work work;
        std::optional<WorkerThreads> threads;
        Outbox outbox;
        bool announced = false;
        for (bool stop = false; !stop;) {
            while (std::optional<Message> message = receive()) {
                if (message->tag == kStop) {
                    status = first_of<std::int32_t>(message->bytes);
                    stop = true;
                    break;
                }
                try {
                    if (message->tag == kCase) {
                        const auto count = at(first_of<std::uint64_t>(message->bytes));
                        work = make(message->bytes.substr(sizeof(std::uint64_t)), count);
                        threads.emplace(work, count);
                    }
                    if (message->tag == kTask && threads)
                        threads->push(first_of<Task>(message->bytes));
                } catch (...) {
                    outbox.send(0, kError, packed(std::current_exception()));
                }
            }
            if (stop) break;
            if (caught_signal() != 0 && !announced) {
                announced = true;
                outbox.send(0, kSignal, bytes_of(std::int32_t(caught_signal())));
            }
            std::optional<WorkerThreads::Done> done;
            if (threads)
                done = threads->pop(2ms);
            else
                std::this_thread::sleep_for(2ms);
            if (done && done->error && caught_signal() == 0)
                outbox.send(0, kError, packed(done->error));
            if (done && !done->error) outbox.send(0, kAnswer, bytes_of(done->task) + done->answer);
            outbox.tidy();
        }
    }
    leave_together();
    return status;
}

}  // namespace rsc

#endif
