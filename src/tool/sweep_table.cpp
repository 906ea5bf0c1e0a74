#include "tool/sweep_table.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <iostream>
#include <utility>

#include "io/file_bytes.h"
#include "split_mapf/core/error.h"
#include "split_mapf/core/wording.h"
#include "tool/csv.h"

namespace split_mapf::tool {

SweepTable::Descriptor::~Descriptor() {
  if (opened >= 0) ::close(opened);
}

SweepTable::SweepTable(std::string path, Shape shape, bool resume)
    : path_(std::move(path)), shape_(std::move(shape)) {
  if (path_ == "-") {
    file_ = STDOUT_FILENO;
  } else {
    open(resume);
  }
  if (!regular_ || ::lseek(file_, 0, SEEK_END) == 0) write(csvRow(shape_.columns));
}

void SweepTable::open(bool resume) {
  constexpr mode_t kReadableByAll = 0666;
  opened_.opened = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, kReadableByAll);
  file_ = opened_.opened;
  if (file_ < 0) failToWrite();
  struct stat status = {};
  regular_ = ::fstat(file_, &status) == 0 && S_ISREG(status.st_mode);
  if (!regular_) {
    if (resume) throw InputError(path_ + ": is no plain file; one that can be resumed is expected");
    return;
  }
  if (::flock(file_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
    throw InputError(path_ +
                     ": is being written by another process; each shard needs its own file");
  }
  if (resume) {
    readRows();
  } else if (::ftruncate(file_, 0) != 0) {
    failToWrite();
  }
}

void SweepTable::readRows() {
  const std::string text = readFile(path_);
  const CsvRows read = readCsv(text);
  for (const CsvRows::Row& row : read.rows) {
    if (row.line == 1) {
      if (row.fields == shape_.columns) continue;
      failAtLine(path_, row.line, "other columns than those of this version of bench");
    }
    if (row.fields.size() != shape_.columns.size()) {
      failAtLine(path_, row.line,
                 counted(row.fields.size(), "field") + "; " +
                     std::to_string(shape_.columns.size()) + " are expected");
    }
    before_.insert(
        {row.fields.begin(), row.fields.begin() + static_cast<std::ptrdiff_t>(shape_.key_columns)});
  }
  if (read.whole_bytes == text.size()) return;
  if (::ftruncate(file_, static_cast<off_t>(read.whole_bytes)) != 0) failToWrite();
  std::cerr << "split_mapf: " << path_
            << ": the last row was cut off in the middle and is taken away ("
            << counted(text.size() - read.whole_bytes, "byte") << ")\n";
}

void SweepTable::add(const std::vector<std::string>& fields) { write(csvRow(fields)); }

void SweepTable::write(const std::string& row) {
  const off_t begin = regular_ ? ::lseek(file_, 0, SEEK_END) : 0;
  std::size_t written = 0;
  while (written < row.size()) {
    const ssize_t bytes = ::write(file_, row.data() + written, row.size() - written);
    if (bytes > 0) {
      written += static_cast<std::size_t>(bytes);
    } else if (bytes == 0 || errno != EINTR) {
      const int reason = errno;
      // A full disk may have taken the first half of the row.
      if (regular_ && ::ftruncate(file_, begin) != 0) failToWrite();
      errno = reason;
      failToWrite();
    }
  }
  if (regular_ && ::fdatasync(file_) != 0) failToWrite();
}

void SweepTable::failToWrite() const {
  throw InputError((path_ == "-" ? "standard output" : path_) +
                   ": cannot be written: " + std::strerror(errno));
}

}  // namespace split_mapf::tool
