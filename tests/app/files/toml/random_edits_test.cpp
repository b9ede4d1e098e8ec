// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "app/files/rig/rig_edit.h"
#include "app/files/rig/rig_file.h"
#include "app/files/toml/toml_edit.h"

/// Properties of random edits of the shipped rigs and recipes. The expected result is kept here as
/// paths and printed values, apart from the editor's own check.
namespace orbwatch::app::files {
namespace {

std::string content_of(const std::string& file) {
  std::ostringstream text;
  text << std::ifstream(ORBWATCH_SOURCE_DIR "/" + file).rdbuf();
  EXPECT_FALSE(text.str().empty()) << file;
  return text.str();
}

const std::vector<std::string> kRigs = {
    "platform/config/demo-rig.toml", "platform/config/gige-camera-rig.toml",
    "platform/config/usb-camera-rig.toml", "tests/bench/reference/rig.toml"};
const std::vector<std::string> kRecipes = {
    "platform/config/demo-recipe.toml", "platform/config/gige-camera-recipe.toml",
    "platform/config/usb-camera-recipe.toml", "tests/bench/reference/recipe.toml"};

/// Printed values by path, such as "camera[1].width"; tables and lists have an entry of their own.
using Values = std::map<std::string, std::string>;

void collect(const toml::node& node, const std::string& path, Values& values) {
  if (const toml::table* table = node.as_table()) {
    values[path] = "table";
    for (const auto& [key, inner] : *table) {
      collect(inner, path + "." + std::string(key.str()), values);
    }
  } else if (const toml::array* list = node.as_array()) {
    values[path] = "list";
    for (std::size_t i = 0; i < list->size(); ++i) {
      collect((*list)[i], path + "[" + std::to_string(i) + "]", values);
    }
  } else {
    std::ostringstream text;
    node.visit([&text](const auto& value) { text << value; });
    values[path] = text.str();
  }
}

bool is_within(const std::string& path, const std::string& outer) {
  return path == outer || path.starts_with(outer + ".") || path.starts_with(outer + "[");
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

/// The comments of lines, whose strings must not have line ends.
std::vector<std::string> comments_of(const std::vector<std::string>& lines) {
  std::vector<std::string> comments;
  for (const std::string& line : lines) {
    bool is_quoted = false;
    for (std::size_t i = 0; i < line.size(); ++i) {
      if (line[i] == '"') is_quoted = !is_quoted;
      if (is_quoted || line[i] != '#') continue;
      comments.push_back(line.substr(i));
      break;
    }
  }
  return comments;
}

/// The lines of `some` occur in this order in `all`.
bool has_in_order(const std::vector<std::string>& all, const std::vector<std::string>& some) {
  auto at = all.begin();
  for (const std::string& line : some) {
    at = std::find(at, all.end(), line);
    if (at == all.end()) return false;
    ++at;
  }
  return true;
}

/// Random changes of one text, and the result that they must have.
class RandomEdit {
 public:
  RandomEdit(const std::string& text, std::mt19937& random)
      : edit_(std::move(*TomlEdit::make(text, "random.toml"))), random_(random) {
    for (const std::string& line : lines_of(text)) lines_.push_back({line});
    collect(edit_.root(), "", expected_);
    find_tables(edit_.root(), "", "");
  }

  void change() {
    const Table& table = tables_[below(tables_.size())];
    const std::string added = "added_" + std::to_string(++count_);
    std::vector<std::string> keys;
    for (const auto& [key, node] : *table.node) {
      if (!node.is_array_of_tables()) keys.emplace_back(key.str());
    }
    if (keys.empty()) return;
    const std::string& key = keys[below(keys.size())];
    switch (below(5)) {
      case 0:
        return set(table, added);
      case 1:
        return add_table(table, added);
      case 2:
        return add_element(table);
      case 3:
        return table.node->get(key)->is_table() ? remove(table, key) : set(table, key);
      default:
        return remove(table, key);
    }
  }

  Result<std::string> finish() const { return edit_.finish(); }
  int changed() const { return static_cast<int>(paths_.size()); }
  const Values& expected() const { return expected_; }

  /// Lines of the text in which nothing changes.
  std::vector<std::string> kept_lines() const {
    std::vector<std::string> lines;
    for (const Line& line : lines_) {
      if (!line.is_changed) lines.push_back(line.text);
    }
    return lines;
  }

  /// Comments of all lines that are not removed.
  std::vector<std::string> comments() const {
    std::vector<std::string> lines;
    for (const Line& line : lines_) {
      if (!line.is_removed) lines.push_back(line.text);
    }
    return comments_of(lines);
  }

 private:
  struct Table {
    const toml::table* node;
    const toml::array* list;  ///< nullptr: the table is not an element
    std::string path;
    std::string header;
  };
  struct Line {
    std::string text;
    bool is_changed = false;
    bool is_removed = false;
  };

  std::size_t below(std::size_t end) {
    return std::uniform_int_distribution<std::size_t>(0, end - 1)(random_);
  }

  std::string a_value() {
    const std::string number = std::to_string(below(1000)) + ".5";
    switch (below(4)) {
      case 0:
        return number;
      case 1:
        return "[\n  1, " + number + ",\n  -2\n]";
      case 2:
        return "\"größer # than [" + number + "]\"";
      default:
        return "true";
    }
  }

  void find_tables(const toml::table& table, const std::string& path, const std::string& header) {
    for (const auto& [key, node] : table) {
      const std::string name(key.str());
      const std::string inner = header.empty() ? name : header + "." + name;
      if (const toml::table* nested = node.as_table()) {
        tables_.push_back({nested, nullptr, path + "." + name, inner});
        find_tables(*nested, path + "." + name, inner);
      }
      if (!node.is_array_of_tables()) continue;
      const toml::array& list = *node.as_array();
      for (std::size_t i = 0; i < list.size(); ++i) {
        const std::string place = path + "." + name + "[" + std::to_string(i) + "]";
        tables_.push_back({list[i].as_table(), &list, place, inner});
        find_tables(*list[i].as_table(), place, inner);
      }
    }
  }

  /// False: another change concerns that place, and both cannot be made.
  bool claim(const std::string& path) {
    const bool is_taken = std::ranges::any_of(paths_, [&](const std::string& other) {
      return is_within(path, other) || is_within(other, path);
    });
    if (!is_taken) paths_.push_back(path);
    return !is_taken;
  }

  void expect(const std::string& path, const std::string& toml) {
    std::erase_if(expected_, [&](const auto& value) { return is_within(value.first, path); });
    if (!toml.empty()) collect(*toml::parse(toml).get("value"), path, expected_);
  }

  void set(const Table& table, const std::string& key) {
    const std::string path = table.path + "." + key, value = a_value();
    if (!claim(path)) return;
    if (const toml::node* old = table.node->get(key)) {
      for (auto n = old->source().begin.line; n <= old->source().end.line; ++n) {
        lines_[n - 1].is_changed = true;
      }
    }
    edit_.set(*table.node, key, value);
    expect(path, "value = " + value);
  }

  void add_table(const Table& table, const std::string& key) {
    if (!claim(table.path + "." + key)) return;
    edit_.add_table(*table.node, table.header + "." + key, "x = 1\ny = [2]\n");
    expect(table.path + "." + key, "value = { x = 1, y = [2] }");
  }

  void add_element(const Table& table) {
    if (!table.list) return;
    const std::string path = table.path.substr(0, table.path.rfind('[')) + "[" +
                             std::to_string(table.list->size()) + "]";
    if (!claim(path)) return;
    edit_.add_element(*table.list, table.header, "x = 1\n");
    expect(path, "value = { x = 1 }");
  }

  void remove(const Table& table, const std::string& key) {
    const std::string path = table.path + "." + key;
    if (!claim(path)) return;
    const toml::node& node = *table.node->get(key);
    for (auto n = node.source().begin.line; n <= last_line(node); ++n) {
      lines_[n - 1].is_changed = lines_[n - 1].is_removed = true;
    }
    edit_.remove(*table.node, key);
    expect(path, "");
  }

  static toml::source_index last_line(const toml::node& node) {
    toml::source_index last = node.source().end.line;
    const auto see = [&last](const toml::node& inner) { last = std::max(last, last_line(inner)); };
    if (const toml::table* table = node.as_table()) {
      for (const auto& [key, inner] : *table) see(inner);
    }
    if (const toml::array* list = node.as_array()) {
      for (const toml::node& inner : *list) see(inner);
    }
    return last;
  }

  TomlEdit edit_;
  std::mt19937& random_;
  std::vector<Table> tables_;
  std::vector<Line> lines_;
  Values expected_;
  std::vector<std::string> paths_;
  int count_ = 0;
};

std::string with_returns(const std::string& text) {
  std::string out;
  for (const char c : text) out += c == '\n' ? "\r\n" : std::string(1, c);
  return out;
}

class RandomEdits : public testing::TestWithParam<std::string> {};

TEST_P(RandomEdits, ChangeTheirValuesAndNothingElse) {
  const std::string text = content_of(GetParam());
  ASSERT_TRUE(text.ends_with('\n'));
  std::mt19937 random(32);
  int changed = 0;
  for (const std::string& form : {text, with_returns(text), text.substr(0, text.size() - 1)}) {
    const bool has_returns = form.find('\r') != std::string::npos;
    for (int turn = 0; turn < 200; ++turn) {
      RandomEdit edit(form, random);
      for (int n = 0; n < 1 + turn % 5; ++n) edit.change();
      const auto made = edit.finish();
      ASSERT_TRUE(made) << made.error().message << " in turn " << turn;
      Values values;
      collect(toml::parse(*made), "", values);
      ASSERT_EQ(values, edit.expected()) << *made;
      const auto lines = lines_of(*made);
      ASSERT_TRUE(has_in_order(lines, edit.kept_lines())) << *made;
      ASSERT_EQ(comments_of(lines), edit.comments()) << *made;
      for (const std::string& line : lines) {
        ASSERT_EQ(line.ends_with('\r'), has_returns) << line << " of\n" << *made;
      }
      changed += edit.changed();
    }
  }
  EXPECT_GT(changed, 600);
}

INSTANTIATE_TEST_SUITE_P(Rigs, RandomEdits, testing::ValuesIn(kRigs),
                         [](const auto& info) { return "N" + std::to_string(info.index); });
INSTANTIATE_TEST_SUITE_P(Recipes, RandomEdits, testing::ValuesIn(kRecipes),
                         [](const auto& info) { return "N" + std::to_string(info.index); });

/// Every number that an alignment can have.
std::vector<double> numbers_of(const optics::RigCamera& camera) {
  std::vector<double> all = {camera.is_registered ? 1.0 : 0.0, camera.alpha.value_or(-1),
                             camera.distance.value_or(-1)};
  const auto add = [&all](const optics::Mat3& m) {
    for (const optics::Vec3& row : {m.row0, m.row1, m.row2}) {
      all.insert(all.end(), {row.x, row.y, row.z});
    }
  };
  add(camera.registration);
  if (const auto& limb = camera.outline) {
    all.insert(all.end(), {limb->centre.u, limb->centre.v, limb->rx, limb->ry, limb->angle});
  }
  if (const auto& lens = camera.intrinsics) {
    all.insert(all.end(), {lens->fx, lens->fy, lens->cx, lens->cy});
  }
  if (const auto& pose = camera.pose) {
    add(pose->rotation);
    all.insert(all.end(), {pose->position.x, pose->position.y, pose->position.z});
  }
  return all;
}

class RandomAlignments : public testing::TestWithParam<std::string> {
 protected:
  double about(double value, double deviation) {
    return std::normal_distribution<double>(value, deviation)(random_);
  }

  optics::Mat3 turned(const optics::Mat3& rotation) {
    return rotation * optics::rotation({about(0, 3), about(0, 3), about(0, 3)});
  }

  CameraAlignment alignment(const optics::RigCamera& camera) {
    CameraAlignment found{camera.name};
    if (camera.pose) {
      const optics::Vec3& p = camera.pose->position;
      found.pose = {turned(camera.pose->rotation), {about(p.x, 5), about(p.y, 5), about(p.z, 5)}};
      found.intrinsics = camera.intrinsics;
      found.intrinsics->fx = found.intrinsics->fy = about(camera.intrinsics->fx, 20);
    } else {
      const optics::Outline& limb = *camera.outline;
      const double radius = about(limb.rx, 3);
      found.outline = {
          {about(limb.centre.u, 5), about(limb.centre.v, 5)}, radius * 1.001, radius, about(0, 90)};
      found.registration = turned(camera.registration);
    }
    return found;
  }

  std::mt19937 random_{33};
};

TEST_P(RandomAlignments, AreWrittenWithEveryNumber) {
  const std::string text = content_of(GetParam());
  const auto rig = parse_rig(text, GetParam(), ".");
  ASSERT_TRUE(rig) << rig.error().message;
  for (int turn = 0; turn < 50; ++turn) {
    for (const optics::RigCamera& camera : rig->cameras) {
      const RigAlignment change{std::nullopt, {alignment(camera)}};
      optics::Rig expected = *rig;
      ASSERT_TRUE(apply(change, expected));
      const auto made = aligned_rig(text, GetParam(), ".", change);
      ASSERT_TRUE(made) << made.error().message;
      const auto written = parse_rig(*made, GetParam(), ".");
      ASSERT_TRUE(written) << written.error().message;
      for (std::size_t i = 0; i < rig->cameras.size(); ++i) {
        const auto stated = numbers_of(written->cameras[i]),
                   meant = numbers_of(expected.cameras[i]);
        ASSERT_EQ(stated.size(), meant.size()) << *made;
        for (std::size_t n = 0; n < meant.size(); ++n) {
          EXPECT_NEAR(stated[n], meant[n], 1e-9 * (1 + std::abs(meant[n]))) << n << " of\n"
                                                                            << *made;
        }
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Rigs, RandomAlignments, testing::ValuesIn(kRigs),
                         [](const auto& info) { return "N" + std::to_string(info.index); });

}  // namespace
}  // namespace orbwatch::app::files
