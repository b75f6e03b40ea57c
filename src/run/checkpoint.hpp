// The state of an interrupted campaign on the disk: a file beside the result file,
// `<result>.checkpoint`.
//
// It is a sequence of frames (kind, length, checksum, bytes): one with the program and the case,
// one with the sums over the first realizations, and one for each finished realization that is not
// yet in the sums. Frames are appended as realizations finish; when they take more space than the
// sums, a new file (sums of all that can be added, and the remaining frames) replaces the old one.
// A process killed at any moment leaves at most an incomplete frame at the end, which is ignored:
// only the realizations in progress are lost. NetCDF is not used, because a process killed while it
// writes may leave a file that cannot be opened.
#pragma once

#include "case/case.hpp"
#include "observe/record.hpp"

namespace rsc {

std::string checkpoint_name(const std::string& result_file);

class Checkpoint {
public:
    struct Contents {
        std::optional<std::string> sums;   // as last written by rewrite()
        std::vector<std::string> records;  // in the order they were appended
    };

    // Opens the state of the campaign `settings`, and locks it while it is open.
    //   resume = false   starts a new one. Throws Error(bad_input) with a remedy if there is one
    //                    already, so that none is lost by accident.
    //   resume = true    continues with the existing one, if any: take_contents() has its
    //                    contents. Throws Error(bad_input) if it belongs to another case, with the
    //                    keys that differ, or to another version, or is damaged.
    // Throws Error(bad_input) if another process has it open, Error(file_system) if it cannot be
    // written.
    Checkpoint(const std::string& result_file, const Case& settings, bool resume);
    Checkpoint(const Checkpoint&) = delete;
    Checkpoint& operator=(const Checkpoint&) = delete;
    ~Checkpoint();  // does not remove the file

    const std::string& name() const { return name_; }
    Contents take_contents() { return std::move(contents_); }

    // Adds a finished realization. After an error (disk full: Error(file_system)) the file is as it
    // was before the call.
    void append(const std::string& record);

    // True if the appended records take more space than the rest: time to rewrite(). The total
    // written is then at most three times the size of all records.
    bool wants_rewrite() const;
    // Rewrites the file. If the disk is full the file stays as it is, and may continue to grow.
    void rewrite(const std::string& sums, const std::vector<const std::string*>& records);

    // Removes the file of a finished campaign.
    void remove();

    // "surface%sigma: 0.01 there, 0.02 now": one line for each key that differs and must not;
    // of_there and of_now name the two cases.
    static std::vector<std::string> differences(const Case& there, const Case& now,
                                                const std::string& of_there = "there",
                                                const std::string& of_now = "now");

private:
    void create();
    void load(const Case& settings);
    void cut(std::uint64_t size);
    void write(const std::string& frame);
    void sync_now_and_then();

    std::string name_;
    std::string header_;  // bytes of the first frame
    int fd_ = -1;
    std::uint64_t size_ = 0;       // bytes of complete frames
    std::uint64_t base_size_ = 0;  // of them before the appended records
    std::uint64_t next_rewrite_ = 0;
    Contents contents_;
    std::chrono::steady_clock::time_point last_sync_;
    double sync_seconds_ = 0;  // duration of the last one
};

// Records and sums of a campaign as bytes, for checkpoints and for other ranks. The bytes are in
// the machine's own format: the same program on the same kind of machine reads them back bit for
// bit. They are not meant for archiving.

std::string to_bytes(const RealizationRecord& record);
// The sums alone; the options come from the case.
std::string to_bytes(const Accumulators& sums);

// Throw Error(internal) for invalid bytes.
RealizationRecord record_from_bytes(std::string_view bytes);
void sums_from_bytes(std::string_view bytes, Accumulators& sums);

// The number of the realization alone.
std::int64_t realization_of(std::string_view record_bytes);

// Changes with the layout of the bytes.
std::string archive_layout();

}  // namespace rsc
