// The readers of file formats, each in its own source file; read/inputs.cpp selects one by the first bytes of a file. All throw
// Error(bad_input) with the line or byte of the error.
#pragma once

#include "format.hpp"
#include "rough/surface.hpp"

namespace rsc {

// Gwyddion's own files (.gwy), a tree of named values (http://gwyddion.net/documentation/user-guide-en/gwyfile-format.html). is_gwy() is
// true for the first bytes of such a file. Reads the channel named `channel`, or by default the first one whose values are lengths;
// missing points (NaN, or those under the channel's mask) are NaN. Lengths are converted to length_unit. The first row of the file, the
// top of the picture, has the largest y; x0 = y0 = 0.
bool is_gwy(const std::string& start);
HeightMap read_gwy(const std::string& path, const std::string& channel, const std::string& length_unit);

// Surface data files (.sdf) of ISO 25178-71, text and binary, and of its predecessor BCR. is_sdf() is true for their first bytes: aISO-1.0,
// bISO-1.0, aBCR-1.0, ... The heights are converted from metres to length_unit; missing points (BAD in a text, the least value of a signed
// integer type, the largest of an unsigned one, NaN or the least double) are NaN. Rows and origin as in read_gwy().
bool is_sdf(const std::string& start);
HeightMap read_sdf(const std::string& path, const std::string& length_unit);

// A rectangular table: value (row, column) = values[row*columns + column]; line[row] is the row's line in the file, from 1.
struct TextTable {
    std::size_t rows = 0, columns = 0;
    std::vector<double> values;
    std::vector<long> line;
};

// Numbers in columns from a text file, separated by blanks or tabs, by a comma, or by a semicolon (adjacent blanks are ignored); the
// same separator is required throughout. With semicolons the decimal mark may be a comma, but then throughout. `#` starts a comment; empty
// lines are skipped; exponents may be Fortran's (1.5d-3). `columns`: the required number, or 0 for that of the first row. With `missing`
// the words nan and bad are missing values: NaN. Throws Error(bad_input) for words that are no finite number, rows of different length or
// separator, files without rows, and UTF-16.
TextTable read_table(const std::string& path, std::size_t columns, bool missing = false);

// A number as Fortran reads it. Empty for other words, and for an exponent without a letter: in a file "12-3" is rather two numbers that have
// lost their separator.
std::optional<double> number_in_file(std::string_view word);

// A word of a file for a message, in quotes.
inline std::string shown(std::string_view word) { return "'" + printable(word, 40) + (word.size() > 40 ? "...'" : "'"); }

}  // namespace rsc
