// A fresh folder, removed with everything in it.
#pragma once

#include "check.hpp"

struct Folder {
    std::string name = (std::filesystem::temp_directory_path() / "rsc-test-XXXXXX").string();
    std::filesystem::path path = ::mkdtemp(name.data());
    Folder() = default;
    Folder(const Folder&) = delete;
    ~Folder() { std::filesystem::remove_all(path); }
    std::string operator/(const std::string& name) const { return (path / name).string(); }
    // The path of a new file.
    std::string write(const std::string& name, const std::string& content) const {
        std::ofstream(*this / name, std::ios::binary) << content;
        return *this / name;
    }
    std::size_t files() const {
        return std::distance(std::filesystem::recursive_directory_iterator(path),
                             std::filesystem::recursive_directory_iterator());
    }
};

// The content of a file.
inline std::string bytes(const std::string& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}
