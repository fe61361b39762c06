// SPDX-License-Identifier: GPL-2.0-or-later
#include "report/page_parts.hpp"

#include <algorithm>
#include <cctype>

#include "report/page.hpp"

namespace qmorph::report {
namespace {

std::string escaped_html(const std::string& text) {
  std::string escaped;
  for (char c : text) {
    if (c == '&' || c == '<' || c == '>' || c == '"')
      escaped += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : "&quot;";
    else
      escaped += c;
  }
  return escaped;
}

/// JSON that may stand inside a <script>: no `<` that could end it.
std::string script_json(const nlohmann::ordered_json& json) {
  const std::string text = json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
  std::string escaped;
  escaped.reserve(text.size());
  for (char c : text) {
    if (c == '<')
      escaped += "\\u003c";
    else
      escaped += c;
  }
  return escaped;
}

}  // namespace

std::string shell_word(const std::string& word) {
  const auto is_plain = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) ||
           std::string_view("-_=+,./:@%^").find(c) != std::string_view::npos;
  };
  if (!word.empty() && std::all_of(word.begin(), word.end(), is_plain)) return word;
  std::string quoted = "'";
  for (char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

std::string command_line(const std::vector<std::string>& arguments) {
  std::string line = "qmorph";
  for (const std::string& word : arguments) line += ' ' + shell_word(word);
  return line;
}

std::string fill_page(std::string_view page, const std::string& title, const nlohmann::ordered_json& facts,
                      const Blob& blob) {
  std::string out;
  const auto replace_up_to = [&](std::string_view mark, const std::string& text) {
    const std::size_t at = page.find(mark);
    out.append(page.substr(0, at)).append(text);
    page.remove_prefix(at + mark.size());
  };
  const std::string numbers = blob.text(), json = script_json(facts);
  out.reserve(page.size() + numbers.size() + json.size() + title.size());
  replace_up_to("{{TITLE}}", escaped_html(title));
  replace_up_to("{{FACTS}}", json);
  replace_up_to("{{NUMBERS}}", numbers);
  return out.append(page);
}

std::string file_name(const std::string& path) { return path.substr(path.find_last_of('/') + 1); }

}  // namespace qmorph::report
