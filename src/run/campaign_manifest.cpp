#include "run/campaign_manifest.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <system_error>

#include "case/registry.hpp"
#include "case/units.hpp"
#include "error.hpp"
#include "file/netcdf_file.hpp"
#include "file/netcdf_writer.hpp"
#include "file/output_path.hpp"
#include "version.h"

namespace rsc {
namespace fs = std::filesystem;
namespace {

const Key& key_of(const std::string& axis) {
    const std::size_t percent = axis.find('%');
    return *find_key(axis.substr(0, percent), axis.substr(percent + 1, axis.find('(') - percent - 1));
}

// "solids%R(2)" -> "solids_R_2".
std::string variable_name(const std::string& axis) {
    std::string name;
    for (char c : axis)
        if (c != ')') name += c == '%' || c == '(' ? '_' : c;
    return name;
}

// UDUNITS spelling of the registry's units; sigma and the unit of the levels have none.
std::string units_of(const Key& key, const Case& settings) {
    const std::string unit = key.unit, &l = settings.run.length_unit, &f = settings.run.force_unit;
    if (unit == "length") return unit_of(l, 1);
    if (unit == "force/length^2") return unit_of(l, -2, f, 1);
    return unit == "1" ? "1" : "";
}

// None where the members have different ones.
std::string units_of(const Key& key, const std::vector<Member>& members) {
    const std::string first = units_of(key, members.front().settings);
    for (const Member& member : members)
        if (units_of(key, member.settings) != first) return "";
    return first;
}

// The file as seen from the manifest's folder.
std::string relative_name(const std::string& file, const std::string& manifest) {
    const fs::path folder = fs::path(manifest).parent_path();
    const fs::path relative = fs::path(file).lexically_relative(folder.empty() ? fs::path(".") : folder);
    return relative.empty() ? file : relative.string();
}

std::size_t longest(const std::vector<std::string>& texts) {
    std::size_t most = 1;
    for (const std::string& text : texts) most = std::max(most, text.size());
    return most;
}

void add_axis(NetcdfFile& file, const std::string& axis, const std::vector<Member>& members, std::size_t number) {
    const Key& key = key_of(axis);
    const std::string name = variable_name(axis);
    const NetcdfAttributes attributes{{"key", axis}};
    if (key.type == Type::real || key.type == Type::integer) {
        std::vector<double> values;
        std::vector<std::int32_t> whole;
        bool finite = true;
        for (const Member& member : members) {
            const std::string text = get_key(member.settings, axis);
            const bool infinite = text.find("Inf") != std::string::npos;
            finite = finite && !infinite && !text.empty();
            if (!finite) break;
            values.push_back(std::stod(text));
            whole.push_back(static_cast<std::int32_t>(values.back()));
        }
        if (finite && key.type == Type::integer) return file.variable({name, {"member"}, "1", key.meaning, whole, attributes, false});
        if (finite) return file.variable({name, {"member"}, units_of(key, members), key.meaning, values, attributes, false});
    }
    std::vector<std::string> values;
    for (const Member& member : members) values.push_back(member.values[number].second);
    const std::string length = name + "_length";
    file.dimension(length, longest(values));
    file.variable({name, {"member", length}, "", key.meaning, values, attributes, false});
}

constexpr const char* kTextStart = "# member\tfile";
const FileKind kTextManifest{"manifest", [](const std::string& path) { return begins_with(path, kTextStart); }};
const FileKind kManifest{"manifest", kResultFile.is_one};

// Beside the NetCDF manifest.
std::string text_manifest_file(const std::string& manifest) { return fs::path(manifest).replace_extension(".txt").string(); }

std::string text_manifest(const std::vector<Member>& members, const std::string& manifest) {
    std::string text = kTextStart;
    for (const auto& [key, value] : members.front().values) text += "\t" + key;
    for (const Member& member : members) {
        text += "\n" + std::to_string(member.index) + "\t" + relative_name(member.settings.output.file, manifest);
        for (const auto& [key, value] : member.values) text += "\t" + value;
    }
    return text + "\n";
}

bool holds(const std::string& path, const std::string& text) {
    std::ifstream in(path, std::ios::binary);
    std::ostringstream there;
    there << in.rdbuf();
    return in && there.str() == text;
}

}  // namespace

std::string manifest_file(const std::string& output_file) {
    const fs::path path(output_file);
    fs::path name = path.stem();
    name += "_manifest.nc";
    return (path.parent_path() / name).string();
}

void check_manifest(const std::string& output_file, const std::vector<std::string>& inputs) {
    const std::string path = manifest_file(output_file), text_path = text_manifest_file(path);
    const auto refuse = [](const std::string& name, const std::string& why) {
        throw Error(Failure::bad_input, "the manifest of the study, '" + name + "': " + why + " (let &output file have another name)");
    };
    std::error_code error;
    for (const std::string& input : inputs)
        for (const std::string& name : {path, text_path})
            if (fs::is_regular_file(input, error) && fs::equivalent(input, name, error)) refuse(name, "this is an input of the run");
    if (const std::string why = reason_to_leave(path, kManifest); !why.empty()) refuse(path, why);
    if (const std::string why = reason_to_leave(text_path, kTextManifest); !why.empty()) refuse(text_path, why);
}

void write_manifest(const ReadCase& read, const std::vector<Member>& members, const std::string& command) {
    const std::string path = manifest_file(read.settings.output.file), text_path = text_manifest_file(path);
    const std::string text = text_manifest(members, path);
    std::error_code ignored;
    if (const fs::path folder = fs::path(path).parent_path(); !folder.empty()) fs::create_directories(folder, ignored);

    const Case base = without_idle_keys(read.settings);
    NetcdfFile file;
    file.attribute("Conventions", "CF-1.10");
    file.attribute("title", read.settings.run.title.empty() ? "Manifest of a study" : read.settings.run.title + ": manifest of the study");
    file.attribute("source", "rsc " RSC_VERSION);
    file.attribute("history", history_text(command));
    file.attribute("comment",
                   "member k of the study is `file`(k), beside this one; the other variables are the keys that differ between members");
    file.attribute("case", effective_namelist(base) + effective_namelist(*read.study));
    file.dimension("member", members.size());
    std::vector<std::int32_t> numbers;
    std::vector<std::string> names;
    for (const Member& member : members) {
        numbers.push_back(member.index);
        names.push_back(relative_name(member.settings.output.file, path));
    }
    file.dimension("file_length", longest(names));
    file.variable({"member", {"member"}, "1", "number of the member", numbers, {}, false});
    file.variable({"file", {"member", "file_length"}, "", "result file of the member", names, {}, false});
    for (std::size_t k = 0; k < members.front().values.size(); ++k) add_axis(file, members.front().values[k].first, members, k);
    file.write(path, read.settings.output.format, read.settings.output.compression);
    if (!holds(text_path, text)) write_whole(text_path, kTextManifest, text);
}

std::string member_name(const Member& member) {
    if (member.values.empty()) return {};
    std::string text = "member " + std::to_string(member.index) + " (";
    for (std::size_t k = 0; k < member.values.size(); ++k)
        text += (k > 0 ? " " : "") + member.values[k].first + "=" + member.values[k].second;
    return text + ")";
}

std::string list_members(const std::vector<Member>& members) {
    std::string text;
    for (const Member& member : members) {
        text += std::to_string(member.index) + "  " + member.settings.output.file + " ";
        for (const auto& [key, value] : member.values) text += " " + key + "=" + value;
        text += "\n";
    }
    return text;
}

}  // namespace rsc
