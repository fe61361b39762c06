// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// A .msh file as what it consists of: lines, and numbers, which are text or bytes.

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "gmsh/read/msh/file.hpp"

namespace qmorph::adapter {

/// A whole file, mapped: nothing of it is in memory before it is looked at.
class MappedFile {
 public:
  /// \throws InputError
  explicit MappedFile(const std::string& path);
  ~MappedFile();
  MappedFile(const MappedFile&) = delete;
  MappedFile& operator=(const MappedFile&) = delete;
  std::string_view text() const { return {data_, size_}; }

 private:
  const char* data_ = nullptr;
  std::size_t size_ = 0;
};

/// Reads a file from the front. Whatever is asked for and not there is an InputError that names the file.
class MshNumbers {
 public:
  MshNumbers(const std::string& path, std::string_view text) : path_(path), text_(text) {}
  /// From the line with the version on, numbers are bytes, in this order or the other one.
  void be_binary(bool swapped) { binary_ = true, swapped_ = swapped; }
  bool is_binary() const { return binary_; }

  /// The rest of the line, without blanks at its end; empty lines count.
  std::string_view line();
  /// Up to and including the line that begins so. \return the lines before it, or -1 if there is no such line
  long long skip_to_line(std::string_view begin);
  bool at_end() const { return at_ >= text_.size(); }
  std::size_t left() const { return text_.size() - at_; }

  /// An int of the format.
  long long integer();
  /// A size_t of the format.
  long long size();
  /// As `integer()` and `size()`, but always text.
  long long word();
  void skip_reals(std::size_t count);
  /// Always text.
  void skip_real_words(std::size_t count);
  /// A word that is no number.
  std::string_view token();
  std::string_view peek_token();
  std::string_view peek_bytes(std::size_t count) const { return text_.substr(at_, count); }

  /// Refuses counts of things that need at least so many bytes each where the file has not so many any more: before
  /// memory is taken for them.
  void require_room(long long count, std::size_t bytes_each, std::string_view of_what);

  [[noreturn]] void fail(const std::string& what) const;
  const std::string& path() const { return path_; }

 private:
  template <class Number>
  Number raw();
  void skip_blanks();

  const std::string& path_;
  std::string_view text_;
  std::size_t at_ = 0;
  bool binary_ = false, swapped_ = false;
};

}  // namespace qmorph::adapter
