// SPDX-License-Identifier: GPL-2.0-or-later
#include <fmt/format.h>

#include <algorithm>

#include "cli/request/options.hpp"
#include "cli/request/request.hpp"
#include "cli/request/rules.hpp"
#include "cli/request/take_gmsh_option.hpp"
#include "qmorph/error.hpp"

namespace qmorph::cli {
namespace {

/// Gmsh's own default: everything but debugging.
constexpr int kDefaultVerbosity = 5;

using Words = std::vector<std::string>;

/// One option with the words that belong to it, or a file.
struct Item {
  std::string word;  ///< without "=VALUE"
  std::optional<Option> option;
  Words values;
};

/// Goes through the words of the command line.
class Arguments {
 public:
  explicit Arguments(const Words& words) : words_(words) {}

  bool is_at_end() const { return at_ == words_.size(); }

  Item next() {
    Item item;
    item.word = words_[at_++];
    // --name=value is the spelling of other programs; let it be ours as well. A file's name may have a '=', too.
    const std::size_t equals = item.word.starts_with("--") ? item.word.find('=') : std::string::npos;
    item.option = find_option(item.word.substr(0, equals));
    if (!item.option) return item;
    if (equals != std::string::npos) {
      item.values.push_back(item.word.substr(equals + 1));
      item.word.resize(equals);
    }
    take_values(item);
    return item;
  }

 private:
  void take_values(Item& item) {
    const int values = item.option->values();
    std::size_t wanted = values < 0 ? 2 : std::size_t(values);
    while (item.values.size() < wanted && !is_at_end()) {
      const std::string& word = words_[at_];
      // -3 is an option, but also a number that this option may refuse in its own words.
      if (values == 1 && look_up(word) && !to_number(word))
        throw UsageError(fmt::format("'{}' needs a value before '{}'", item.word, word));
      item.values.push_back(word);
      ++at_;
      // A name and a count, and then as many words.
      if (values < 0 && item.values.size() == 2) wanted += std::size_t(std::max(0, to_whole_number(word).value_or(0)));
    }
    if (item.values.size() != wanted)
      throw UsageError(fmt::format("'{}' needs {} value{}", item.word, wanted, wanted == 1 ? "" : "s"));
  }

  const Words& words_;
  std::size_t at_ = 0;
};

}  // namespace

Request parse(const Words& arguments) {
  Request request;
  request.verbosity = kDefaultVerbosity;
  Words files;
  std::vector<std::string_view> given;  // our options, as --help spells them
  for (Arguments left(arguments); !left.is_at_end();) {
    const Item item = left.next();
    if (!item.option) {
      files.push_back(item.word);
      continue;
    }
    if (item.option->gmsh) {
      take_gmsh_option(*item.option->gmsh, item.values, request);
      continue;
    }
    const OurOption& option = *item.option->ours;
    const std::string text = item.values.empty() ? "" : item.values.front();
    const bool is_repeated = std::find(given.begin(), given.end(), option.word()) != given.end();
    if (option.use != Use::flag && text.empty()) throw UsageError(fmt::format("{} needs a value", option.word()));
    if (option.use == Use::once && is_repeated) throw UsageError(fmt::format("{} is given twice", option.word()));
    option.apply(request, {option.word(), text});
    given.push_back(option.word());
  }
  if (request.help || request.version) return request;
  if (files.empty() && !request.gui) throw UsageError("which file? (qmorph IN [-o OUT])");
  if (!files.empty()) {
    request.input = files.front();
    request.merged.assign(files.begin() + 1, files.end());
  }
  check_combination(request, given);
  return request;
}

}  // namespace qmorph::cli
