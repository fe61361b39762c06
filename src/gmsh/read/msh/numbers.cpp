// SPDX-License-Identifier: GPL-2.0-or-later
#include "gmsh/read/msh/numbers.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstring>
#include <limits>

#include "qmorph/error.hpp"

namespace qmorph::adapter {
namespace {

bool is_blank(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

/// Of a word, in a message.
constexpr std::size_t kShown = 20;

/// What a number may consist of, "nan" and "inf" too.
bool is_of_a_number(char c) {
  return (c >= '0' && c <= '9') || c == '.' || c == '-' || c == '+' || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

}  // namespace

MappedFile::MappedFile(const std::string& path) {
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  struct stat status {};
  const bool open = file >= 0 && ::fstat(file, &status) == 0;
  if (open && status.st_size > 0) {
    size_ = static_cast<std::size_t>(status.st_size);
    void* memory = ::mmap(nullptr, size_, PROT_READ, MAP_PRIVATE, file, 0);
    if (memory != MAP_FAILED) data_ = static_cast<const char*>(memory);
  }
  if (file >= 0) ::close(file);
  if (!open || (size_ > 0 && !data_)) throw InputError(fmt::format("{} cannot be read", path));
}

MappedFile::~MappedFile() {
  if (data_) ::munmap(const_cast<char*>(data_), size_);
}

void MshNumbers::fail(const std::string& what) const { throw InputError(fmt::format("{} {}", path_, what)); }

std::string_view MshNumbers::line() {
  if (at_end()) fail("ends too soon: it is not complete");
  const std::size_t end = std::min(text_.find('\n', at_), text_.size());
  std::string_view line = text_.substr(at_, end - at_);
  at_ = std::min(end + 1, text_.size());
  while (!line.empty() && is_blank(line.back())) line.remove_suffix(1);
  return line;
}

long long MshNumbers::skip_to_line(std::string_view begin) {
  for (long long lines = 0; !at_end(); ++lines)
    if (line().substr(0, begin.size()) == begin) return lines;
  return -1;
}

void MshNumbers::skip_blanks() {
  while (at_ < text_.size() && is_blank(text_[at_])) ++at_;
}

long long MshNumbers::word() {
  skip_blanks();
  if (at_end()) fail("ends too soon: it is not complete");
  const char* first = text_.data() + at_;
  const char* last = text_.data() + text_.size();
  long long value = 0;
  const auto [end, error] = std::from_chars(first + (*first == '+'), last, value);
  if (error == std::errc::result_out_of_range) fail("has a whole number that no computer has room for");
  if (error != std::errc() || (end != last && !is_blank(*end)))
    fail(fmt::format("has '{}' where a whole number is to be", peek_token().substr(0, kShown)));
  at_ += static_cast<std::size_t>(end - first);
  return value;
}

std::string_view MshNumbers::peek_token() {
  skip_blanks();
  std::size_t end = at_;
  while (end < text_.size() && !is_blank(text_[end])) ++end;
  return text_.substr(at_, end - at_);
}

std::string_view MshNumbers::token() {
  const std::string_view token = peek_token();
  at_ += token.size();
  return token;
}

template <class Number>
Number MshNumbers::raw() {
  std::array<char, sizeof(Number)> bytes{};
  if (left() < bytes.size()) fail("ends too soon: it is not complete");
  std::memcpy(bytes.data(), text_.data() + at_, bytes.size());
  at_ += bytes.size();
  if (swapped_) std::reverse(bytes.begin(), bytes.end());
  Number number;
  std::memcpy(&number, bytes.data(), sizeof number);
  return number;
}

long long MshNumbers::integer() { return binary_ ? raw<std::int32_t>() : word(); }

long long MshNumbers::size() {
  if (!binary_) return word();
  const auto value = raw<std::uint64_t>();
  // More than any file can mean; as a count or a tag it is refused by what follows.
  return static_cast<long long>(std::min<std::uint64_t>(value, std::numeric_limits<long long>::max()));
}

void MshNumbers::skip_reals(std::size_t count) {
  if (!binary_) return skip_real_words(count);
  if (left() / sizeof(double) < count) fail("ends too soon: it is not complete");
  at_ += count * sizeof(double);
}

void MshNumbers::skip_real_words(std::size_t count) {
  for (; count > 0; --count) {
    skip_blanks();
    const std::size_t begin = at_;
    while (at_ < text_.size() && is_of_a_number(text_[at_])) ++at_;
    if (at_ == begin && at_end()) fail("ends too soon: it is not complete");
    if (at_ > begin && (at_end() || is_blank(text_[at_]))) continue;
    at_ = begin;
    fail(fmt::format("has '{}' where a number is to be", peek_token().substr(0, kShown)));
  }
}

void MshNumbers::require_room(long long count, std::size_t bytes_each, std::string_view of_what) {
  if (count < 0 || static_cast<unsigned long long>(count) > left() / bytes_each)
    fail(fmt::format("contradicts itself: it says that it has {} {}, and ends {} bytes further on", count, of_what,
                     left()));
}

}  // namespace qmorph::adapter
