// SPDX-License-Identifier: Apache-2.0
#include "app/cli/place/tag_options.h"

#include <set>
#include <sstream>

#include "app/files/text/text_file.h"

namespace orbwatch::app::cli {
namespace {

using align::PrintedTag;
using optics::Vec3;

Vec3 vec3(const std::vector<double>& numbers, std::size_t first) {
  return {numbers[first], numbers[first + 1], numbers[first + 2]};
}

std::array<Vec3, 4> corners_of(const std::vector<double>& n) {
  if (n.size() == 12) return {vec3(n, 0), vec3(n, 3), vec3(n, 6), vec3(n, 9)};
  return align::tag_corners(n[0], vec3(n, 1), vec3(n, 4), vec3(n, 7));
}

}  // namespace

Result<PrintedTag> parse_tag(const std::string& text) {
  const std::size_t equals = text.find('=');
  const auto id = parse_whole("tag", text.substr(0, equals));
  const auto numbers =
      parse_numbers("tag", equals == std::string::npos ? "" : text.substr(equals + 1));
  if (!id || !numbers || (numbers->size() != 12 && numbers->size() != 10)) {
    return fail("--tag is \"" + text +
                "\"; it must be ID= and its four corners, or its size, centre, and directions to "
                "the right and down; see --help");
  }
  if (*id < 0 || *id >= align::kTagIds) {
    return fail("tag " + std::to_string(*id) + ": the family 36h11 has 0 to " +
                std::to_string(align::kTagIds - 1));
  }
  const PrintedTag tag{*id, corners_of(*numbers)};
  if (!align::is_square(tag.corners)) {
    return fail(
        "tag " + std::to_string(*id) +
        ": its corners are not a square; give them as one reads the tag: top left, top right, "
        "bottom right, bottom left");
  }
  return tag;
}

Result<std::vector<PrintedTag>> read_tags(const std::filesystem::path& file) {
  files::TextFiles files;
  const auto text = files.read(file, "a list of tags");
  if (!text) return tl::unexpected(text.error());
  std::vector<PrintedTag> tags;
  std::istringstream lines(*text);
  int number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    line.resize(std::min(line.size(), line.find('#')));
    std::erase_if(line, [](char c) { return c == ' ' || c == '\t' || c == '\r'; });
    if (line.empty()) continue;
    const auto tag = parse_tag(line);
    if (!tag) {
      return fail(file.string() + ":" + std::to_string(number) + ": " + tag.error().message);
    }
    tags.push_back(*tag);
  }
  return tags;
}

Result<> check_tags(const std::vector<PrintedTag>& tags) {
  std::set<int> ids;
  for (const PrintedTag& tag : tags) {
    if (!ids.insert(tag.id).second)
      return fail("tag " + std::to_string(tag.id) + " is given twice");
  }
  return {};
}

}  // namespace orbwatch::app::cli
