#pragma once
/// From words on the command line to what is wanted.

#include <optional>
#include <string>
#include <vector>

namespace qmorph::cli {

/// One call of the command.
struct Request {
  std::string input, output, format, stats;
  std::vector<int> surfaces;
  std::vector<std::string> settings;        ///< NAME=VALUE for set_option()
  int verbosity = 0;
  bool help = false, version = false;
  bool cleanup_only = false;  ///< improve the quads that are there
  bool algorithm_chosen = false;
  std::optional<double> msh_version;        ///< of -setnumber Mesh.MshFileVersion
  std::optional<bool> binary;               ///< of -bin, or of -setnumber Mesh.Binary
  std::vector<std::string> option_names;    ///< of Gmsh ("Mesh.Smoothing"), set by -setnumber and -setstring
  std::vector<std::string> gmsh_arguments;  ///< for Gmsh, in their order: the last one of a kind wins
};

/// \throws UsageError naming the word that is wrong
Request parse(const std::vector<std::string>& arguments);

/// The text of --help.
std::string help_text();

}  // namespace qmorph::cli
