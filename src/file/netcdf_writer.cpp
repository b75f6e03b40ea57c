#include "file/netcdf_writer.hpp"

#include "error.hpp"
#include "file/netcdf_table.hpp"
#include "version.h"

namespace rsc {
namespace {

std::string date() {
    std::time_t now = std::time(nullptr);
    if (const char* epoch = std::getenv("SOURCE_DATE_EPOCH")) {
        char* end = nullptr;
        const long long seconds = std::strtoll(epoch, &end, 10);
        if (end != epoch && *end == '\0') now = static_cast<std::time_t>(seconds);
    }
    std::tm utc{};
    gmtime_r(&now, &utc);
    char text[32];
    return {text, std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &utc)};
}

}  // namespace

std::string history_text(const std::string& command) { return date() + " " + (command.empty() ? "rsc " RSC_VERSION : command); }

void write_result(const Result& result, const std::string& path, const WriteOptions& options) {
    const Observations& o = result.observations;
    if (o.realizations == 0 || o.steps == 0) throw Error(Failure::internal, "result file: there is nothing to write, no level was run");
    ResultTable(result).make(history_text(options.command)).write(path, options.format, options.compression);
}

}  // namespace rsc
