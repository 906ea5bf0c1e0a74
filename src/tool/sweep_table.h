#pragma once

#include <set>
#include <string>
#include <vector>

namespace split_mapf::tool {

/// The CSV file of a sweep. Each row is written whole, in one piece that is on the disk before the
/// next is begun, so that a sweep that is killed goes on behind its last row. One process writes a
/// table at a time.
class SweepTable {
 public:
  struct Shape {
    std::vector<std::string> columns;
    std::size_t key_columns;  ///< the first so many tell which cell a row is of
  };
  using Key = std::vector<std::string>;  ///< the fields of these columns

  /// @param path  `-` for standard output.
  /// @param resume  go on with the rows that are there; else whatever is there goes. A row that was
  /// cut off in the middle is taken away, which is said on standard error.
  /// @throws InputError where the file cannot be written, is being written by another process, or
  /// has not these columns.
  SweepTable(std::string path, Shape shape, bool resume);

  /// Which cells have a row from before.
  const std::set<Key>& rowsFromBefore() const { return before_; }
  /// @throws InputError where it cannot be written; the table is then as it was.
  void add(const std::vector<std::string>& fields);

 private:
  /// Closes the file that was opened.
  struct Descriptor {
    Descriptor() = default;
    ~Descriptor();
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    int opened = -1;
  };

  void open(bool resume);
  /// Leaves the whole rows in the file.
  void readRows();
  void write(const std::string& row);
  [[noreturn]] void failToWrite() const;

  const std::string path_;
  const Shape shape_;
  Descriptor opened_;
  int file_ = -1;         ///< that, or standard output
  bool regular_ = false;  ///< a plain file: can be locked, cut and forced to the disk
  std::set<Key> before_;
};

}  // namespace split_mapf::tool
