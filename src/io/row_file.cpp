// Writes a table of text rows that stays readable if the disk is full or the program crashes.
#include "io/row_file.h"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "io/pipe_room.h"

namespace barehand {

Result<RowFile> RowFile::create(const std::string& path, std::string_view header, bool overwrite) {
  auto whole = AtomicFile::create(path, overwrite);
  if (!whole) return tl::unexpected(whole.error());
  RowFile rows(path, header, std::move(*whole));
  if (const int file = rows.whole_.open(); file >= 0) rows.file_.reset(fdopen(file, "w"));
  if (rows.file_) std::setvbuf(rows.file_.get(), nullptr, _IONBF, 0);
  if (rows.file_ && rows.append(rows.header_)) return rows;

  // A disk that is full now may have room for the rows.
  const int reason = errno;
  const bool full = reason == ENOSPC || reason == EDQUOT || reason == EFBIG;
  rows.headless_ = rows.file_ && full && !rows.whole_.direct() && rows.cut_back();
  if (rows.headless_) return rows;
  return fail(std::string("cannot be written: ") + std::strerror(reason), path,
              "check the folder, its permissions and the free space");
}

RowFile::~RowFile() {
  if (has_rows_) (void)finish();
}

Result<void> RowFile::finish() {
  if (!file_) return {};
  const bool headless = headless_ && !whole_.direct() && !append(header_);
  const int reason = errno;
  file_.reset();
  if (!headless) return whole_.finish();
  whole_.discard();
  return fail(std::string("cannot be written: ") + std::strerror(reason), path_, "free some space");
}

/// Cuts the file back to the end of the last complete write, if that is possible.
bool RowFile::cut_back() {
  std::clearerr(file_.get());
  return ftruncate(fileno(file_.get()), good_) == 0 && fseeko(file_.get(), good_, SEEK_SET) == 0;
}

bool RowFile::append(std::string_view text) {
  errno = 0;
  if (std::fwrite(text.data(), 1, text.size(), file_.get()) != text.size()) return false;
  good_ += static_cast<std::int64_t>(text.size());
  return true;
}

Result<void> RowFile::write(std::string_view rows) {
  // Refuse what cannot be written.
  if (!file_) return fail("the table is finished, nothing more is written", path_);
  if (torn_) return fail("an earlier write failed and could not be undone, nothing more is written", path_);
  if (!has_room(fileno(file_.get()), header_.size() + rows.size()))
    return fail("the reader of this pipe is behind", path_, "rows are left out until it has read more");

  // Write the rows, after the header if it is still to be written.
  if (headless_ ? append(header_ + std::string(rows)) : append(rows)) {
    headless_ = false;
    has_rows_ = true;
    return {};
  }

  // A pipe without a reader gets the header again later.
  const int reason = errno;
  if (reason == EPIPE) {
    std::clearerr(file_.get());
    headless_ = true;
    return fail("no program reads this pipe", path_, "the table starts again when one does");
  }

  // Cut the file back to the end of the last complete write.
  torn_ = whole_.direct() || !cut_back();
  return fail(std::string("cannot be written: ") + std::strerror(reason), path_,
              torn_ ? "the table ends in an incomplete frame, which readers ignore"
                    : "the frames before this one are kept; free some space");
}

}  // namespace barehand
