// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Gmsh's own window.

#include <string>

namespace qmorph::adapter {

/// The display that a window is to be opened on. It is tried beforehand, since Gmsh's toolkit ends the process if there
/// is none. Keep this until the window is open: some displays shut down when their last client leaves.
class Display {
 public:
  Display();
  ~Display();
  Display(const Display&) = delete;
  Display& operator=(const Display&) = delete;
  /// Why there can be no window, or an empty string.
  const std::string& trouble() const { return trouble_; }

 private:
  void* connection_ = nullptr;
  std::string trouble_;
};

/// Opens a mesh file in Gmsh's window and waits until it is closed. The window lives in a process of its own, since its
/// toolkit ends the process if it finds no display. \return what went wrong, or an empty string
std::string show_in_window(const std::string& path);

}  // namespace qmorph::adapter
