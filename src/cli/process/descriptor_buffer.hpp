// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// A stream buffer on a file descriptor.

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <streambuf>

namespace qmorph::cli {

/// A file descriptor to write to, without delay.
class DescriptorBuffer : public std::streambuf {
 public:
  explicit DescriptorBuffer(int descriptor) : descriptor_(descriptor) {}

 protected:
  std::streamsize xsputn(const char* text, std::streamsize length) override {
    std::streamsize done = 0;
    while (done < length) {
      const ::ssize_t written = ::write(descriptor_, text + done, static_cast<std::size_t>(length - done));
      if (written < 0 && errno != EINTR) break;
      done += std::max<::ssize_t>(written, 0);
    }
    return done;
  }
  int_type overflow(int_type c) override {
    const char character = traits_type::to_char_type(c);
    return traits_type::eq_int_type(c, traits_type::eof()) || xsputn(&character, 1) == 1 ? traits_type::not_eof(c)
                                                                                         : traits_type::eof();
  }

 private:
  int descriptor_;
};

}  // namespace qmorph::cli
