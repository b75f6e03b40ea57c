// Numbers in columns from a text file.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace rsc {

// A rectangular table: value (row, column) = values[row*columns + column]; line[row] is the row's line in the file, from 1.
struct TextTable {
    std::size_t rows = 0, columns = 0;
    std::vector<double> values;
    std::vector<long> line;
};

// Reads `path`: numbers separated by blanks or tabs, by a comma, or by a semicolon (blanks beside them do no harm): one of the three
// throughout the file. Between semicolons the decimal mark may be a comma; then it is so throughout. `#` starts a comment; empty lines
// are skipped; Fortran's exponents (1.5d-3) are understood. `columns` wanted, or 0: as many as the first row has. Throws
// Error(bad_input) naming the line of a word that is no finite number, of a row longer or shorter than the others or separated
// otherwise, or that nothing is there; UTF-16 is refused by name. With `missing` the words nan and bad are values: NaN.
TextTable read_table(const std::string& path, std::size_t columns, bool missing = false);

}  // namespace rsc
