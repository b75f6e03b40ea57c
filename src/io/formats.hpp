// The readers of file formats, each in its own source file; io/inputs.cpp selects one by the first
// bytes of a file. All throw Error(bad_input) with the line or byte of the error.
#pragma once

#include "base/error.hpp"
#include "surface/surface.hpp"

namespace rsc {

struct MapKeys;

// Gwyddion's own files (.gwy), a tree of named values
// (http://gwyddion.net/documentation/user-guide-en/gwyfile-format.html). is_gwy() is true for the
// first bytes of such a file. Reads the first channel named `channel`, or the one of this number if
// none has this name; by default the first one whose values are lengths. Missing points (NaN, or
// those under the channel's mask) are NaN. Lengths are converted to length_unit; `keys` apply to a
// channel without units. Rows go from the top of the picture to the bottom: the first has the
// largest y; x0 = y0 = 0.
bool is_gwy(const std::string& start);
// `title` (optional) receives the name of the channel.
HeightMap read_gwy(const std::string& path, const std::string& channel,
                   const std::string& length_unit, const MapKeys& keys,
                   std::string* title = nullptr);
// True if the channel that would be read has no unit of its heights or of its sides.
bool gwy_lacks_units(const std::string& path, const std::string& channel);

// Surface data files (.sdf) of ISO 25178-71, text and binary, and of its predecessor BCR. is_sdf()
// is true for their first bytes: aISO-1.0, bISO-1.0, aBCR-1.0, ... In a text `;` begins a comment,
// lines end with CR, LF or both, and Compression, DataType and CheckType may be words (NULL,
// INTEGER). The heights are converted from metres to length_unit; missing points (BAD in a text,
// the least value of a signed type, the largest of an unsigned one, in BCR the largest of any, NaN)
// are NaN. Profile j lies at y = j Yscale: the first row has the lowest y; x0 = y0 = 0. There are
// no channels and no title; lengths are always in metres, so that `keys` do not apply.
bool is_sdf(const std::string& start);
// A file with one profile gives a map of one row.
HeightMap read_sdf(const std::string& path, const std::string& channel,
                   const std::string& length_unit, const MapKeys& keys, std::string* title);

// A rectangular table: value (row, column) = values[row*columns + column]; line[row] is the row's
// line in the file, from 1.
struct TextTable {
    std::size_t rows = 0, columns = 0;
    std::vector<double> values;
    std::vector<long> line;
    // Units that the comments name.
    struct UnitMention {
        enum Kind { values, width, height, coordinates, spacing, other } kind = other;
        std::string unit;
        double size = 0;  // of width, height and spacing, in `unit`
        long line = 0;
    };
    std::vector<UnitMention> units;
    const UnitMention* mention(UnitMention::Kind kind) const;  // the first; null if there is none
    // True if a comment states a width: a matrix, however few columns it has.
    bool matrix() const { return mention(UnitMention::width) != nullptr; }
    // True for the heading of Gwyddion's exports, which states the width and the height of a
    // picture in two successive lines.
    bool picture() const;
};

// A text in UTF-8: one in another encoding is converted from ISO 8859-1.
std::string utf8(std::string_view text);

// A path, or a name of a new file for a converted copy, for the command line of a shell.
std::string for_shell(const std::string& path);
std::string copy_for_shell(const std::string& path, const std::string& ending);

// What helps with files of instruments that rsc does not read.
std::string gwyddion_advice(const std::string& path);

// Numbers in columns from a text file, which gzip may have packed, separated by blanks or tabs, by
// a comma, or by a semicolon (adjacent blanks are ignored); the same separator is required
// throughout. With semicolons the decimal mark may be a comma, but then throughout. `#` starts a
// comment; empty lines are skipped; exponents may be Fortran's (1.5d-3). `columns`: the required
// number, or 0 for that of the first row. With `missing` the words nan and bad and empty cells
// between commas or semicolons are missing values: NaN. Throws Error(bad_input) for words that are
// no finite number, rows of different length or separator, files without rows, and UTF-16.
TextTable read_table(const std::string& path, std::size_t columns, bool missing = false);

// A profile in a text, as instruments export it: the longest block of lines with as many numbers
// each, in the styles of read_table(), after lines of text without '#'. The last of these names the
// units of the columns: "Lateral (um), Profile (nm)". SigmaSurf's texts name step and unit as
// SPACING_UM and PROFILE_UM. Throws Error(bad_input) as read_table(), and if there are several long
// blocks, as a damaged line leaves them.
TextTable read_profile_table(const std::string& path, bool missing);

// A number as Fortran reads it. Empty for other words, and for an exponent without a letter: in a
// file "12-3" is rather two numbers that have lost their separator.
std::optional<double> number_in_file(std::string_view word);

// A word of a file for a message, in quotes.
std::string shown(std::string_view word);

// Checks of the size of a height map before its memory is allocated, and a reader of binary files.

// Throws Error(bad_input) if `what`, of `count` doubles, needs more memory than the machine has:
// the size in a damaged file may be arbitrary.
void check_memory(const std::string& path, const std::string& what, double count);

// Throws Error(bad_input) unless a map has at least 3 x 3 points, at most 2^31 - 1 a side, and fits
// into memory.
void check_grid(const std::string& path, std::size_t nx, std::size_t ny);

// Rows without padding, as for the functions below.
HeightMap allocate_map(std::size_t nx, std::size_t ny);
void scale_heights(HeightMap& map, double factor);

// Reverse the order of columns or rows.
void reverse_columns(HeightMap& map);
void reverse_rows(HeightMap& map);

// The bytes of a binary file, read in order; reading beyond their end throws an error with the
// position.

// A file for reading; its bytes are unpacked if gzip packed them. Reading throws Error(bad_input)
// if the system fails, or for a packed file that is cut or damaged.
class UnpackedFile : public std::streambuf {
public:
    explicit UnpackedFile(const std::string& path);
    UnpackedFile(const UnpackedFile&) = delete;
    UnpackedFile& operator=(const UnpackedFile&) = delete;
    ~UnpackedFile() override;

protected:
    int_type underflow() override;

private:
    std::string path_;
    void* file_;  // a gzFile
    std::array<char, 1 << 16> buffer_;
};

// All bytes of a file, and the first ones, at most 4096, unpacked.
std::string read_bytes(const std::string& path);
std::string first_bytes(const std::string& path);

// The next line of a text, without its end: CR, LF or CRLF. False at the end of the text.
bool next_line(std::streambuf& text, std::string& line);

// Little-endian numbers.
class ByteReader {
public:
    ByteReader(const std::string& path, std::string_view bytes, std::size_t at, std::size_t end)
        : path_(path), bytes_(bytes), at_(at), end_(end) {}

    std::size_t at() const { return at_; }
    std::size_t left() const { return end_ - at_; }
    const std::string& path() const { return path_; }
    [[noreturn]] void refuse(const auto&... what) const {
        bad_input(path_, ": at byte ", at_, ": ", what...);
    }

    // The next `count` items of `size` bytes each; `what` names them in messages.
    std::string_view take(std::size_t count, std::size_t size, const std::string& what) {
        if (count > left() / size)
            refuse(what, " of ", count, " x ", size, " bytes, but ", left(),
                   " are left; is the file complete?");
        const std::string_view taken = bytes_.substr(at_, count * size);
        at_ += count * size;
        return taken;
    }
    template <class T>
    T number(const std::string& what) {
        return value<T>(take(1, sizeof(T), what).data());
    }
    // Up to a zero byte.
    std::string_view text(const std::string& what) {
        const std::size_t zero = bytes_.substr(at_, left()).find('\0');
        if (zero == std::string_view::npos) refuse(what, " has no end; is the file complete?");
        const std::string_view taken = bytes_.substr(at_, zero);
        at_ += zero + 1;
        return taken;
    }
    template <class T>
    static T value(const char* bytes) {
        static_assert(std::endian::native == std::endian::little);
        T value;
        std::memcpy(&value, bytes, sizeof value);
        return value;
    }

private:
    const std::string& path_;
    std::string_view bytes_;
    std::size_t at_, end_;
};

}  // namespace rsc
