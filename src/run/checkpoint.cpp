#include "run/checkpoint.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zlib.h>

#include "base/archive.hpp"
#include "base/error.hpp"
#include "base/version.h"
#include "case/read_case.hpp"
#include "case/registry.hpp"
#include "io/whole_file.hpp"
#include "run/run.hpp"

namespace rsc {
namespace {

enum : std::uint32_t {
    kHeader = 0x68637372,
    kSums = 0x73637372,
    kRecord = 0x72637372
};  // "rsch", "rscs", "rscr"

struct FrameHead {
    std::uint32_t kind = 0, checksum = 0;
    std::uint64_t length = 0;
};

constexpr std::uint64_t kSmallLog = std::uint64_t{16} << 20;  // smaller files are not rewritten
constexpr double kSyncShare = 0.01;  // largest share of the time spent on waiting for the disk
constexpr double kSyncSeconds = 5;

// Any file may be replaced here, because the process holds its lock, and load() refuses files that
// are no checkpoints.
const FileKind kCheckpoint{"checkpoint", [](const std::string&) { return true; }};

uLong add(uLong crc, const void* data, std::size_t n) {
    return crc32_z(crc, static_cast<const Bytef*>(data), n);
}

// CRC-32 of kind, length and bytes.
std::uint32_t checksum_of(const FrameHead& head, std::string_view bytes) {
    const uLong crc = add(add(0, &head.kind, sizeof head.kind), &head.length, sizeof head.length);
    return std::uint32_t(add(crc, bytes.data(), bytes.size()));
}

std::string frame(std::uint32_t kind, const std::string& bytes) {
    FrameHead head{kind, 0, bytes.size()};
    head.checksum = checksum_of(head, bytes);
    return bytes_of(head) + bytes;
}

struct Frame {
    std::uint32_t kind = 0;
    std::string_view bytes;
};

// Takes the frame at the beginning of `file` from it; none if it is incomplete, damaged or missing.
std::optional<Frame> take_frame(std::string_view& file) {
    FrameHead head;
    if (file.size() < sizeof head) return {};
    std::memcpy(&head, file.data(), sizeof head);
    if (head.length > file.size() - sizeof head) return {};
    const std::string_view bytes = file.substr(sizeof head, at(head.length));
    if (checksum_of(head, bytes) != head.checksum) return {};
    file.remove_prefix(sizeof head + bytes.size());
    return Frame{head.kind, bytes};
}

std::uint32_t kind_at(std::string_view file) {
    std::uint32_t kind = kHeader;
    std::memcpy(&kind, file.data(), std::min(file.size(), sizeof kind));
    return kind;
}

// True if the descriptor belongs to the file that now has this name.
bool still_named(int fd, const std::string& name) {
    struct stat open {
    }, named{};
    return ::fstat(fd, &open) == 0 && ::stat(name.c_str(), &named) == 0 &&
           open.st_ino == named.st_ino && open.st_dev == named.st_dev;
}

std::string header_start() { return joined("rsc " RSC_VERSION "\n", archive_layout(), "\n"); }

// A comment of the namelist with the CRC-32 of the input files: realizations of changed inputs are
// not those of one campaign.
std::string inputs_line(const Case& settings) {
    uLong crc = 0;
    for (const std::string& name : input_files(settings)) {
        std::ifstream in(name, std::ios::binary);
        std::vector<char> part(std::size_t{1} << 20);
        while (in.read(part.data(), std::streamsize(part.size())), in.gcount() > 0)
            crc = add(crc, part.data(), at(in.gcount()));
    }
    return "! inputs " + std::to_string(crc) + "\n";
}

}  // namespace

std::string checkpoint_name(const std::string& result_file) { return result_file + ".checkpoint"; }

Checkpoint::Checkpoint(const std::string& result_file, const Case& settings, bool resume)
    : name_(checkpoint_name(result_file)),
      header_(header_start() + inputs_line(settings) + effective_namelist(settings)),
      last_sync_(std::chrono::steady_clock::now()) {
    for (int attempt = 0; fd_ < 0; ++attempt) {
        if (const std::string why = reason_to_leave(name_, kCheckpoint); !why.empty())
            bad_input("'", name_, "': ", why);
        fd_ = ::open(name_.c_str(), O_RDWR | O_CREAT | O_NOFOLLOW | O_CLOEXEC, 0666);
        if (fd_ < 0) fail_to_write(name_, errno);
        // File systems without locks (ENOLCK, ENOTSUP) are used without one.
        const bool busy = lock_file(fd_) == EAGAIN;
        if (!busy && still_named(fd_, name_))
            break;  // otherwise the file was replaced or removed meanwhile
        ::close(std::exchange(fd_, -1));
        if (busy || attempt == 100)
            bad_input("'", name_, "': another process is running this campaign");
    }
    try {
        load(settings);
        if (base_size_ > 0 && !resume)
            bad_input("'", name_,
                      "' is the checkpoint of an interrupted campaign: continue with --resume, or "
                      "remove that file to "
                      "start from the beginning");
        if (base_size_ == 0) create();
    } catch (...) {
        ::close(fd_);
        throw;
    }
}

Checkpoint::~Checkpoint() {
    if (fd_ >= 0) ::close(fd_);
}

void Checkpoint::create() {
    cut(0);
    write(frame(kHeader, header_));
    base_size_ = size_;
}

// Leaves the first `size` bytes, after which the next frame is written.
void Checkpoint::cut(std::uint64_t size) {
    if (::ftruncate(fd_, static_cast<off_t>(size)) != 0 || ::lseek(fd_, 0, SEEK_END) < 0)
        fail_to_write(name_, errno);
    size_ = size;
}

void Checkpoint::write(const std::string& bytes) {
    if (const int error = write_all(fd_, bytes); error != 0) {
        cut(size_);  // an incomplete frame at the end is ignored, but nothing may follow it
        fail_to_write(name_, error);
    }
    size_ += bytes.size();
}

// Leaves base_size_ = 0 for a new file, or for one whose first frame is incomplete.
void Checkpoint::load(const Case& settings) {
    std::ifstream in(name_, std::ios::binary);
    const std::string all{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
    if (!in.is_open() || in.bad())
        throw Error(Failure::file_system, "cannot read '", name_, "': ", std::strerror(errno));
    std::string_view left = all;
    const auto refuse = [this](const auto&... text) { bad_input("'", name_, "' ", text...); };
    const std::optional<Frame> header = take_frame(left);
    if (!header) {
        // The incomplete first frame of a killed process is accepted; anything else is no
        // checkpoint.
        if (kind_at(all) != kHeader || all.size() > sizeof(FrameHead) + header_.size())
            refuse("is damaged, or no checkpoint of rsc; remove it to start from the beginning");
        return;
    }
    if (header->kind != kHeader) refuse("is not a checkpoint of rsc");
    if (!header->bytes.starts_with(header_start()))
        refuse("was written by another version of rsc (",
               header->bytes.substr(0, header->bytes.find('\n')),
               "), whose numbers may differ in the last bits: finish it with that version, or "
               "remove the file to start from the "
               "beginning");
    const Reading there = read_namelist(header->bytes.substr(header_start().size()));
    if (!there.faults.empty()) refuse("is damaged; remove it to start from the beginning");
    std::string changed;
    for (const std::string& line : differences(there.settings, settings)) changed += "\n  " + line;
    if (!changed.empty())
        refuse("belongs to another case: it cannot be resumed with", changed,
               "\nRestore the old values of these keys, or remove the file to start from the "
               "beginning.");
    if (!header->bytes.substr(header_start().size()).starts_with(inputs_line(settings)))
        refuse(
            "belongs to other contents of the input files: restore them, or remove the checkpoint "
            "to start from the beginning");
    if (!left.empty() && kind_at(left) == kSums) {
        // Sums are written before the file gets its name, so incomplete sums are a disk error.
        const std::optional<Frame> sums = take_frame(left);
        if (!sums)
            refuse("is damaged: its checksum is wrong; remove it to start from the beginning");
        contents_.sums = sums->bytes;
    }
    std::uint64_t whole = base_size_ = all.size() - left.size();
    for (auto record = take_frame(left); record && record->kind == kRecord;
         record = take_frame(left)) {
        contents_.records.emplace_back(record->bytes);
        whole = all.size() - left.size();
    }
    cut(whole);
}

void Checkpoint::append(const std::string& record) {
    write(frame(kRecord, record));
    sync_now_and_then();
}

bool Checkpoint::wants_rewrite() const {
    return size_ - base_size_ > std::max({kSmallLog, base_size_, next_rewrite_});
}

void Checkpoint::rewrite(const std::string& sums, const std::vector<const std::string*>& records) {
    try {
        WholeFile fresh(name_, kCheckpoint);
        std::uint64_t size = 0;
        const auto add = [&](std::uint32_t kind, const std::string& bytes) {
            const std::string whole = frame(kind, bytes);
            fresh.write(whole);
            return size += whole.size();
        };
        add(kHeader, header_);
        const std::uint64_t base = add(kSums, sums);
        for (const std::string* record : records) add(kRecord, *record);
        ::close(std::exchange(fd_, fresh.finish(true)));
        size_ = size;
        base_size_ = base;
        next_rewrite_ = 0;
        last_sync_ = std::chrono::steady_clock::now();
    } catch (const Error&) {
        next_rewrite_ = 2 * (size_ - base_size_);  // not again at once
    }
}

// After kill -9 the file is complete, because the system still writes its buffers. A crash of the
// machine loses what is not on the disk.
void Checkpoint::sync_now_and_then() {
    using Clock = std::chrono::steady_clock;
    const auto start = Clock::now();
    const double since = seconds_since(last_sync_);
    if (since < kSyncSeconds || since * kSyncShare < sync_seconds_) return;
    const int error = ::fdatasync(fd_) != 0 ? errno : 0;
    last_sync_ = Clock::now();
    sync_seconds_ = seconds_since(start);
    if (error == ENOSPC || error == EDQUOT || error == EIO) fail_to_write(name_, error);
}

void Checkpoint::remove() {
    remove_parts_left(name_);
    if (::unlink(name_.c_str()) != 0 && errno != ENOENT) fail_to_write(name_, errno);
}

std::vector<std::string> Checkpoint::differences(const Case& there, const Case& now,
                                                 const std::string& of_there,
                                                 const std::string& of_now) {
    std::vector<std::string> lines;
    const auto shown = [](const std::string& value) {
        return value.empty() ? std::string("unset") : value;
    };
    for (const Key& key : registry()) {
        const std::string name = full_name(key), a = get_key(there, name), b = get_key(now, name);
        // A campaign may grow: realizations of the smaller one are part of the larger one.
        if (name == "run%realizations" && there.run.realizations < now.run.realizations) continue;
        if (a != b && key.changes == Changes::numbers)
            lines.push_back(name + ": " + shown(a) + " " + of_there + ", " + shown(b) + " " +
                            of_now);
    }
    return lines;
}

namespace {

ArchiveReader reader_of(std::string_view bytes) {
    return {bytes, Failure::internal, "a record of a realization has the wrong length"};
}

template <class Archive, class T>
void transfer(Archive& a, T& x);

template <class Archive, class T>
void transfer_each(Archive& a, T& vector) {
    std::uint64_t size = vector.size();
    a(size);
    // When reading, items are appended one by one: a wrong size fails at the end of the bytes,
    // before much memory is allocated.
    if constexpr (!Archive::writing) vector.clear();
    for (std::uint64_t k = 0; k < size; ++k) {
        if constexpr (!Archive::writing) vector.emplace_back();
        transfer(a, vector[k]);
    }
}

// Writes or reads the members of an object; T is const if the archive writes.
template <class Archive, class T>
void transfer(Archive& a, T& x) {
    using Type = std::remove_const_t<T>;
    if constexpr (std::is_same_v<Type, Histogram>) {
        a(x.weight, x.overflow, x.total, x.squares, x.power);
    } else if constexpr (std::is_same_v<Type, Distributions>) {
        a(x.separation, x.levels, x.step);
        for (auto* histogram : {&x.mean_pressure, &x.pressure, &x.spot_area, &x.gap})
            transfer(a, *histogram);
    } else if constexpr (std::is_same_v<Type, MapLevel>) {
        a(x.cell, x.area, x.force, x.outside);
    } else if constexpr (std::is_same_v<Type, DistributionSums>) {
        a(x.step, x.numbers);
    } else if constexpr (std::is_same_v<Type, std::vector<CellSums>>) {
        a(x);
    } else {
        if constexpr (std::is_same_v<Type, RealizationRecord>)
            a(x.realization, x.surface, x.levels, x.curves);
        else
            a(x.realization, x.surface, x.rows, x.curves);
        transfer_each(a, x.maps);
        transfer_each(a, x.distributions);
    }
}

}  // namespace

std::string to_bytes(const RealizationRecord& record) {
    ArchiveWriter writer;
    transfer(writer, record);
    return std::move(writer.bytes);
}

std::string to_bytes(const Accumulators& sums) {
    ArchiveWriter writer;
    writer.bytes.reserve(sizeof(LevelValues) * sums.rows.size() + 65536);
    transfer(writer, sums);
    return std::move(writer.bytes);
}

RealizationRecord record_from_bytes(std::string_view bytes) {
    RealizationRecord record;
    ArchiveReader reader = reader_of(bytes);
    transfer(reader, record);
    reader.end();
    return record;
}

void sums_from_bytes(std::string_view bytes, Accumulators& sums) {
    Accumulators read(sums.options, sums.steps);
    ArchiveReader reader = reader_of(bytes);
    transfer(reader, read);
    reader.end();
    if (read.maps.size() != sums.maps.size() ||
        read.distributions.size() != sums.distributions.size() ||
        read.rows.size() != read.realization.size() * sums.steps ||
        read.surface.size() != read.realization.size() ||
        read.curves.size() != read.rows.size() * values_of(sums.options.curves))
        throw Error(Failure::internal, "the sums of a campaign do not match its case");
    sums = std::move(read);
}

std::int64_t realization_of(std::string_view record_bytes) {
    std::int64_t number = 0;
    ArchiveReader reader = reader_of(record_bytes);
    reader(number);
    return number;
}

std::string archive_layout() {
    const std::uint32_t order = 0x01020304;
    char first = 0;
    std::memcpy(&first, &order, 1);
    return joined("6,", int(first), ",", sizeof(SurfaceStatistics), ",", sizeof(LevelValues));
}

}  // namespace rsc
