// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The model in the window: its triangles, the quads that they became, and the way back.

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "cli/work/call.hpp"
#include "gmsh/read/open.hpp"
#include "gmsh/session/session.hpp"
#include "gmsh/window/live_window.hpp"
#include "gmsh/window/snapshot.hpp"
#include "qmorph/gmsh.hpp"
#include "qmorph/options.hpp"
#include "report/scene.hpp"

namespace qmorph::cli {

/// What a conversion in the window has made.
struct Converted {
  ModelReport model;
  std::optional<EvenReport> even;
  double seconds = 0;  ///< of the conversion alone
};

class Document {
 public:
  Document(const Call& call, adapter::Session& session) : call_(call), session_(session) {}

  /// The file of the command line, as the command opens it but for the mesh, or an empty model. \throws Error
  void open();
  /// Reads the script that is opened anew, as it depends on parameters. \return false if it is none. \throws Error
  bool reopen();
  /// Whether Gmsh has loaded something else since. It is taken as it is then.
  bool has_changed_hands();

  /// Meshes what has no mesh, and has it converted. What was converted before goes back to triangles first.
  /// \throws Error, Cancelled: the model has its triangles then
  /// \param when_meshed may still change the options; no event of the window is handled between that and the conversion
  const Converted& convert(const Request& request, double size_factor, Options options,
                           const std::function<void(Options&)>& when_meshed);
  /// The result of the last conversion, as long as the model has it.
  const Converted* converted() const { return converted_ ? &*converted_ : nullptr; }

  /// \return false if there is nothing to go back to
  bool back_to_triangles();
  /// The quads that back_to_triangles() has taken away. \pre it has, and nothing was done since
  bool forward_to_quads();
  bool shows_triangles() const { return shows_triangles_; }

  /// The mesh before it was converted. \pre converted()
  const adapter::Snapshot& triangles() const { return *triangles_; }

  /// Where save() would write. \throws Error
  std::string target(const Request& request) const;
  /// Writes the model as the command would. \return what to say of it. \throws Error
  std::vector<std::string> save(const Request& request);

 private:
  void mesh(double size_factor);
  void note_state();
  void forget();

  const Call& call_;
  adapter::Session& session_;
  adapter::OpenedModel opened_;
  std::string model_, file_;           ///< Gmsh's names of what is opened
  std::optional<double> meshed_with_;  ///< size factor of a mesh that convert() has asked for
  std::optional<adapter::Snapshot> triangles_, quads_;
  std::optional<Converted> converted_;
  adapter::LoadedState state_;  ///< after what we have done last
  bool shows_triangles_ = false;
};

}  // namespace qmorph::cli
