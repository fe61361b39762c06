// SPDX-License-Identifier: GPL-2.0-or-later
#include "cli/run.hpp"

#include <cxxabi.h>
#include <fmt/format.h>

#include <cstdlib>
#include <exception>
#include <iostream>
#include <memory>
#include <new>
#include <optional>
#include <string_view>
#include <typeinfo>

#include "cli/gui/gui.hpp"
#include "cli/messages/error_stream.hpp"
#include "cli/process/standard_input.hpp"
#include "cli/process/standard_streams.hpp"
#include "cli/request/request.hpp"
#include "cli/work/call.hpp"
#include "cli/work/check_file.hpp"
#include "cli/work/convert_file.hpp"
#include "cli/work/write_mesh.hpp"
#include "gmsh/session/scratch_file.hpp"
#include "qmorph/error.hpp"
#include "report/version.hpp"

namespace qmorph::cli {
namespace {

/// Standard input and output get names as files meanwhile.
int run_with_streams(Request request, const std::vector<std::string>& arguments, std::ostream& out, ErrorStream& err,
                     const Process& process) {
  std::unique_ptr<adapter::ScratchFile> input;
  std::optional<adapter::ScratchFile> output;
  request.from_stdin = request.input == "-";
  request.to_stdout = request.output == "-" || (request.output.empty() && request.from_stdin);
  if (request.from_stdin) {
    input = read_standard_input(std::cin);
    request.input = input->path();
    err.call(request.input, "standard input");
  }
  if (!process.gmsh_home.empty()) err.call(process.gmsh_home + "/.gmsh-tmp", "-string");
  const Call call{request, arguments, out, err, process};
  if (request.check) return check_file(call);
  if (request.gui) return show_gui(call);
  if (!request.to_stdout) return convert_file(call);
  output.emplace(".msh");
  request.output = output->path();
  err.call(request.output, "standard output");
  if (request.format.empty() && request.consumer.empty()) request.format = "msh";
  const int status = convert_file(call);
  answer_with_file(output->path(), out);
  return status;
}

int fail(int status, std::string_view what, std::ostream& err) {
  err << "qmorph: " << what << (status == bad_usage ? " (see qmorph --help)" : "") << '\n';
  return status;
}

/// \throws what run() turns into an exit status
int run_request(const std::vector<std::string>& arguments, std::ostream& out, ErrorStream& err,
                const Process& process) {
  const Request request = parse(arguments);
  if (request.help) answer(help_text(), out);
  if (request.version) answer(fmt::format("qmorph {}\n", kVersion), out);
  if (request.help || request.version) return all_converted;
  const int status = run_with_streams(request, arguments, out, err, process);
  // Where something went wrong, one line of ours says so, and more would only be in the way.
  // Gmsh's window has a log of its own, and what its toolkit says is about nothing that the user has done.
  if (process.slate)
    process.slate->shows_foreign_words = request.verbosity >= 2 && status <= converted_in_part && !request.gui;
  return status;
}

/// "Standard_ConstructionError", say. Call it while an exception is being handled.
std::string name_of_current_exception() {
  const std::type_info* type = abi::__cxa_current_exception_type();
  if (!type) return "an exception of another language";
  int status = 0;
  const std::unique_ptr<char, decltype(&std::free)> name(abi::__cxa_demangle(type->name(), nullptr, nullptr, &status),
                                                         &std::free);
  return name ? name.get() : type->name();
}

}  // namespace

int run(const std::vector<std::string>& arguments, std::ostream& out, std::ostream& err_stream,
        const Process& process) {
  ErrorStream err(err_stream);
  try {
    hold_standard_streams();
    return run_request(arguments, out, err, process);
  } catch (const ReaderError& error) {
    for (const std::string& complaint : error.complaints) fail(not_good_enough, complaint, err);
    return not_good_enough;
  } catch (const UsageError& error) {
    return fail(bad_usage, error.what(), err);
  } catch (const OutputError& error) {
    return fail(cannot_write, error.what(), err);
  } catch (const Error& error) {
    return fail(bad_input, error.what(), err);
  } catch (const std::bad_alloc&) {
    return fail(bad_input, "not enough memory", err);
  } catch (const std::exception& error) {
    return fail(bad_input, fmt::format("a mistake of qmorph: {}", error.what()), err);
  } catch (const std::string& error) {  // Gmsh before 4.10
    return fail(bad_input, fmt::format("Gmsh: {}", error), err);
  } catch (...) {
    // We throw nothing else, but OpenCASCADE does, and Gmsh lets it through.
    return fail(bad_input,
                fmt::format("Gmsh cannot work on this geometry ({}); repair it, or try another version of Gmsh",
                            name_of_current_exception()),
                err);
  }
}

}  // namespace qmorph::cli
