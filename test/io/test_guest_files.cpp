// Files that are written whole or not at all, and what they may replace.
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/error.hpp"
#include "check.hpp"
#include "io/whole_file.hpp"
#include "support/refused.hpp"
#include "support/temporary_folder.hpp"

namespace test_guest_files {

using namespace rsc;

const FileKind kNotes{"note", [](const std::string& path) { return begins_with(path, "note "); }};

bool refused(const std::string& path, const char* word) {
    const std::string message =
        refusal([&] { write_whole(path, kNotes, std::string("note new")); }, Failure::file_system);
    return !message.empty() && message.find(word) != std::string::npos;
}

TEST(test_what_may_be_replaced) {
    const Folder folder;
    const std::string mine = folder / "mine", thesis = folder / "thesis", link = folder / "link",
                      fifo = folder / "fifo";
    write_whole(mine, kNotes, std::string("note 1"));
    write_whole(mine, kNotes, std::string("note 2"));
    CHECK(bytes(mine) == "note 2");
    std::ofstream(thesis) << "thesis";
    CHECK(refused(thesis, "no note") && bytes(thesis) == "thesis");
    CHECK(symlink(mine.c_str(), link.c_str()) == 0 && refused(link, "link") &&
          bytes(mine) == "note 2");
    CHECK(mkfifo(fifo.c_str(), 0600) == 0 && refused(fifo, "plain file"));
    CHECK(refused(folder / ".", "folder"));
    if (geteuid() != 0) CHECK(refused("/dev/null", "plain file"));  // root could lose the device
    CHECK(chmod(mine.c_str(), 0440) == 0 && refused(mine, "read-only") && bytes(mine) == "note 2");
    CHECK(chmod(mine.c_str(), 0640) == 0);
    write_whole(mine, kNotes, std::string("note 3"));
    struct stat status {};
    CHECK(stat(mine.c_str(), &status) == 0 &&
          (status.st_mode & 0777) == 0640);  // who may read it stays
    CHECK(folder.files() == 4);
}

// A link of the temporary's name is not followed, a temporary that is being written is not touched,
// one that was left is removed.
TEST(test_temporaries) {
    const Folder folder;
    const std::string mine = folder / "mine", other = folder / "other";
    std::ofstream(other) << "other";
    CHECK(symlink(other.c_str(), (mine + ".rsc-part-0").c_str()) == 0);
    std::ofstream(mine + ".rsc-part-1") << "left by a writer that was killed";
    const int held = open((mine + ".rsc-part-2").c_str(), O_RDWR | O_CREAT, 0600);
    CHECK(lock_file(held) == 0);
    const int reader = open((mine + ".rsc-part-2").c_str(), O_RDONLY);
    // as HDF5 does, which reads nothing where that fails
    CHECK(flock(reader, LOCK_SH | LOCK_NB) == 0);
    close(reader);
    write_whole(mine, kNotes, std::string("note"));
    CHECK(bytes(mine) == "note" && bytes(other) == "other");
    CHECK(access((mine + ".rsc-part-1").c_str(), F_OK) != 0 &&
          access((mine + ".rsc-part-2").c_str(), F_OK) == 0);
    close(held);
}

// Writers of one file at once, some killed on the way: a reader finds one whole writing or none,
// and nothing is left in the end.
TEST(test_many_writers) {
    const Folder folder;
    const std::string path = folder / "one";
    std::vector<pid_t> children;
    for (char c = 'a'; c < 'e'; ++c) {
        const pid_t child = fork();
        if (child == 0)
            for (;;) write_whole(path, kNotes, "note " + std::string(100000, c));
        children.push_back(child);
    }
    int whole = 0;
    for (int k = 0; k < 300; ++k) {
        const std::string there = bytes(path);
        if (there.empty() && whole == 0) {
            usleep(1000);
            continue;
        }
        ++whole;
        CHECK(there.size() == 100005 && there == "note " + std::string(100000, there.back()));
    }
    CHECK(whole > 0);
    for (const pid_t child : children) {
        kill(child, SIGKILL);
        CHECK(waitpid(child, nullptr, 0) == child);
    }
    write_whole(path, kNotes, std::string("note"));
    CHECK(folder.files() == 1 && bytes(path) == "note");
}

}  // namespace test_guest_files
