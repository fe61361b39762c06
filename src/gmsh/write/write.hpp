// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// From the model to a file.

#include <optional>
#include <string>
#include <vector>

#include "gmsh/read/open.hpp"
#include "gmsh/write/formats.hpp"
#include "gmsh/write/staged_file.hpp"

namespace qmorph::adapter {

/// What to write, decided before any work is done.
struct OutputPlan {
  std::string path;
  std::string name;  ///< what messages call it
  OutputFormat format;
  bool for_reader = false;  ///< written for --for, with new numbers
};

/// Path and format by Gmsh's rules: -format wins over the extension of -o; without -o the name is the input's, with the
/// extension of the format, in the input's directory.
/// \param output, format empty if not given
/// \throws UsageError for a format that Gmsh does not have; OutputError for an extension that Gmsh does not
///         have, a format that cannot hold quads, and a place where nothing can be written
OutputPlan plan_output(const std::string& input, const std::string& output, const std::string& format);

/// What the user wants of the MSH writer beyond the format.
struct MshWish {
  std::optional<double> version;  ///< if the user has named one
  std::optional<bool> binary;
};

/// The file that will become the output once it is committed. `names` as for StagedFile.
StagedFile stage(const OutputPlan& plan, TemporaryNames* names = nullptr);

/// \pre the model is empty: nothing has been opened yet
/// \throws OutputError if this build of Gmsh cannot write the format at all
void check_format(const OutputPlan& plan, TemporaryNames* names = nullptr);

/// Checks that the format has elements of this order. \throws OutputError if not, or if quads of order 2 lack the
/// middle node that they have in this format
void check_elements(const OutputPlan& plan, int order);

/// Changes the model as the format's readers need it.
void prepare_for_format(const OutputPlan& plan);

/// Numbers nodes and elements without gaps. For models that have just been meshed, whose tags nobody knows yet.
void renumber();

/// Surfaces whose elements will not be in the file: by Gmsh's rule, what is in no physical group is left out if there
/// are groups. To be called before partitions are made.
std::vector<int> find_unwritten_surfaces(const OutputPlan& plan, const OpenedModel& opened, const MshWish& wish);

/// All that have elements.
bool leaves_out_every_surface(const OutputPlan& plan, const OpenedModel& opened, const MshWish& wish);

/// There are groups of volumes and none of surfaces: they are meant for a mesh of the volumes, and by Gmsh's rule a
/// mesh of the surfaces would be an empty file.
bool only_volumes_are_grouped(const OutputPlan& plan, const OpenedModel& opened, const MshWish& wish);

/// Describes those surfaces, and data on nodes and elements, which only MSH can hold. \return one line for each warning
std::vector<std::string> describe_unwritten(const OutputPlan& plan, const OpenedModel& opened, const MshWish& wish);

/// Writes the current model, whole or not at all. What came from a .msh file is written in the same version and
/// encoding unless the user wants another, and all of it, whether in physical groups or not.
/// \param file of `stage`; still to be committed
/// \throws OutputError; a previous file is then as it was
void write_model(const OutputPlan& plan, const OpenedModel& opened, const MshWish& wish, StagedFile& file);

/// Copies the input to the output, for when there was nothing to do: nothing can get lost. \throws OutputError
void copy_input(const std::string& input, const OutputPlan& plan, StagedFile& file);

}  // namespace qmorph::adapter
