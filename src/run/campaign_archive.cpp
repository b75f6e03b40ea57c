#include "run/campaign_archive.hpp"

#include <type_traits>
#include <vector>

#include "archive.hpp"

namespace rsc {
namespace {

ArchiveReader reader_of(std::string_view bytes) {
    return {bytes, Failure::internal, "a record of a realization has not the length it should have"};
}

// One function a type for both directions: what is written is what is read.
template <class Archive, class T>
using In = std::conditional_t<Archive::writing, const T, T>;

template <class Archive>
void transfer(Archive& a, In<Archive, CountHistogram>& h) {
    a(h.count), a(h.overflow), a(h.power);
}

template <class Archive>
void transfer(Archive& a, In<Archive, AreaHistogram>& h) {
    a(h.area), a(h.overflow), a(h.total), a(h.squares), a(h.power);
}

template <class Archive>
void transfer(Archive& a, In<Archive, Distributions>& d) {
    a(d.separation), a(d.levels), a(d.step);
    transfer<Archive>(a, d.mean_pressure), transfer<Archive>(a, d.pressure), transfer<Archive>(a, d.spot_area);
}

template <class Archive>
void transfer(Archive& a, In<Archive, MapLevel>& m) {
    a(m.cell), a(m.area), a(m.force), a(m.outside);
}

template <class Archive>
void transfer(Archive& a, In<Archive, DistributionSums>& d) {
    a(d.step), a(d.numbers);
}

template <class Archive, class T>
void transfer_each(Archive& a, T& vector) {
    if constexpr (Archive::writing) {
        a(static_cast<std::uint64_t>(vector.size()));
    } else {
        std::uint64_t size = 0;
        a(size);
        vector.clear();
        // One by one: with a wrong size this fails at the end of the bytes, and does not ask for much memory before.
        for (std::uint64_t k = 0; k < size; ++k) transfer<Archive>(a, vector.emplace_back());
        return;
    }
    for (auto& item : vector) transfer<Archive>(a, item);
}

template <class Archive>
void transfer(Archive& a, In<Archive, RealizationRecord>& r) {
    a(r.realization), a(r.surface), a(r.levels);
    transfer_each(a, r.maps);
    transfer_each(a, r.distributions);
}

template <class Archive>
void transfer(Archive& a, In<Archive, Accumulators>& s) {
    a(s.realization), a(s.surface), a(s.rows), a(s.map_area), a(s.map_force);
    transfer_each(a, s.distributions);
}

}  // namespace

std::string to_bytes(const RealizationRecord& record) {
    ArchiveWriter writer;
    transfer<ArchiveWriter>(writer, record);
    return std::move(writer.bytes);
}

std::string to_bytes(const Accumulators& sums) {
    ArchiveWriter writer;
    writer.bytes.reserve(32 * sums.map_area.size() + sizeof(LevelValues) * sums.rows.size() + 65536);
    transfer<ArchiveWriter>(writer, sums);
    return std::move(writer.bytes);
}

RealizationRecord record_from_bytes(std::string_view bytes) {
    RealizationRecord record;
    ArchiveReader reader = reader_of(bytes);
    transfer<ArchiveReader>(reader, record);
    reader.end();
    return record;
}

void sums_from_bytes(std::string_view bytes, Accumulators& sums) {
    Accumulators read(sums.options, sums.steps);
    ArchiveReader reader = reader_of(bytes);
    transfer<ArchiveReader>(reader, read);
    reader.end();
    if (read.map_area.size() != sums.map_area.size() || read.map_force.size() != sums.map_force.size() ||
        read.distributions.size() != sums.distributions.size() || read.rows.size() != read.realization.size() * sums.steps ||
        read.surface.size() != read.realization.size())
        throw Error(Failure::internal, "the sums of a campaign have not the shape its case gives them");
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
    return "2," + std::to_string(first) + "," + std::to_string(sizeof(SurfaceStatistics)) + "," + std::to_string(sizeof(LevelValues));
}

}  // namespace rsc
