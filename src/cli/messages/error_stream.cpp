// SPDX-License-Identifier: GPL-2.0-or-later
#include "cli/messages/error_stream.hpp"

#include <string_view>

namespace qmorph::cli {

int ErrorStream::Buffer::sync() {
  for (const auto& [path, name] : names)
    for (std::size_t at = 0; (at = line_.find(path, at)) != std::string::npos; at += name.size())
      line_.replace(at, path.size(), name);
  target_ << line_ << std::flush;
  line_.clear();
  return target_ ? 0 : -1;
}

ErrorStream::Buffer::int_type ErrorStream::Buffer::overflow(int_type c) {
  if (c == traits_type::eof()) return traits_type::not_eof(c);
  const char character = traits_type::to_char_type(c);
  const bool is_control = static_cast<unsigned char>(character) < ' ' && std::string_view("\n\r\t").find(character) > 2;
  line_ += is_control ? '?' : character;  // bytes of a file that is not what its name says
  if (line_.back() == '\n') sync();
  return c;
}

}  // namespace qmorph::cli
