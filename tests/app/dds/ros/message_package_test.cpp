#include "app/dds/ros/message_package.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>

#include "app/dds/ros/message_types.h"
#include "app/dds/ros/type_hash.h"

namespace orbwatch::app {
namespace {

namespace fs = std::filesystem;

const fs::path kCommitted = fs::path(ORBWATCH_SOURCE_DIR) / "app/dds/orbwatch_msgs";

std::string text_of(const fs::path& path) {
  const std::ifstream file(path);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

TEST(MessagePackage, IsTheCommittedOne) {
  const auto files = message_package();
  ASSERT_TRUE(files) << files.error().message;
  std::set<std::string> expected;
  for (const PackageFile& file : *files) {
    expected.insert(file.path);
    EXPECT_TRUE(text_of(kCommitted / file.path) == file.text)
        << file.path << " is stale: orbwatch describe messages -o app/dds/orbwatch_msgs";
  }
  std::set<std::string> found;
  for (const auto& entry : fs::recursive_directory_iterator(kCommitted)) {
    if (entry.is_regular_file()) found.insert(fs::relative(entry, kCommitted).string());
  }
  EXPECT_EQ(found, expected);
}

struct Member {
  std::string type;
  std::string name;
  bool operator==(const Member&) const = default;
};
std::ostream& operator<<(std::ostream& out, const Member& m) {
  return out << m.type << " " << m.name;
}

/// The members of the structs that idlc wrote, by the struct's name. What idlc left out of a type
/// is missing here.
std::map<std::string, std::vector<Member>> generated_structs() {
  static const std::regex kStruct(R"(typedef struct (orbwatch_msgs_msg_dds__\w+)_\n\{([^}]*)\})");
  static const std::regex kMember(R"((?:struct )?(\w+(?: \*)?) ?(\w+);)");
  std::map<std::string, std::vector<Member>> structs;
  for (const auto& entry : fs::directory_iterator(ORBWATCH_GENERATED_IDL)) {
    if (entry.path().extension() != ".h") continue;
    const std::string text = text_of(entry.path());
    for (std::sregex_iterator s(text.begin(), text.end(), kStruct), end; s != end; ++s) {
      const std::string body = (*s)[2];
      auto& members = structs[(*s)[1]];
      for (std::sregex_iterator m(body.begin(), body.end(), kMember); m != end; ++m) {
        members.push_back({(*m)[1], (*m)[2]});
      }
    }
  }
  return structs;
}

/// What idlc makes of a type that a .msg file names.
std::string c_type(std::string type) {
  static const std::map<std::string, std::string> kBasic{
      {"bool", "bool"},
      {"float64", "double"},
      {"string", "char *"},
      {"uint8", "uint8_t"},
      {"uint16", "uint16_t"},
      {"uint32", "uint32_t"},
      {"uint64", "uint64_t"},
      {"float64[]", "dds_sequence_double"},
      {"builtin_interfaces/Time", "builtin_interfaces_msg_dds__Time_"}};
  const auto basic = kBasic.find(type);
  if (basic != kBasic.end()) return basic->second;
  const bool sequence = type.ends_with("[]");
  if (sequence) type.resize(type.size() - 2);
  return (sequence ? "dds_sequence_" : "") + ("orbwatch_msgs_msg_dds__" + type + "_");
}

/// The fields of a .msg file as ROS 2 reads them: type and name, a comment behind '#'.
std::vector<Member> fields_of(const std::string& msg) {
  std::vector<Member> fields;
  std::istringstream lines(msg);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line.substr(0, line.find('#')));
    Member field;
    std::string surplus;
    if (!(words >> field.type)) continue;
    EXPECT_TRUE(words >> field.name) << line;
    EXPECT_FALSE(words >> surplus) << line;
    fields.push_back(field);
  }
  return fields;
}

TEST(MessagePackage, DescribesTheTypesThatIdlcMade) {
  const auto structs = generated_structs();
  ASSERT_GE(structs.size(), 11U);
  std::size_t described = 0;
  const auto files = message_package().value();
  for (const PackageFile& file : files) {
    if (!file.path.ends_with(".msg")) continue;
    const auto found =
        structs.find("orbwatch_msgs_msg_dds__" + fs::path(file.path).stem().string());
    ASSERT_NE(found, structs.end()) << file.path;
    std::vector<Member> fields = fields_of(file.text);
    for (Member& field : fields) field.type = c_type(field.type);
    EXPECT_EQ(fields, found->second) << file.path;
    ++described;
  }
  EXPECT_EQ(described, structs.size());
}

/// A .msg file as ROS 2 describes it.
MessageType described(const std::string& name, const std::string& msg) {
  MessageType type{"orbwatch_msgs/msg/" + name, {}, {}};
  for (const Member& member : fields_of(msg)) {
    MessageField field;
    field.name = member.name;
    std::string word = member.type;
    if (word.ends_with("[]")) {
      field.count = FieldCount::Sequence;
      word.resize(word.size() - 2);
    }
    const auto basic = std::ranges::find(kBasicTypes, word, &BasicType::msg);
    if (basic != kBasicTypes.end()) {
      field.kind = basic->kind;
    } else if (const auto slash = word.find('/'); slash != word.npos) {
      field.nested = word.insert(slash, "/msg");
    } else {
      field.nested = "orbwatch_msgs/msg/" + word;
    }
    type.fields.push_back(field);
  }
  return type;
}

TEST(MessagePackage, HashesToWhatOurEndpointsAnnounce) {
  const MessageTypes& ours = message_types().value();
  MessageTypes package{{"builtin_interfaces/msg/Time", ours.at("builtin_interfaces/msg/Time")}};
  for (const auto& entry : fs::directory_iterator(kCommitted / "msg")) {
    if (entry.path().extension() != ".msg") continue;
    const MessageType type = described(entry.path().stem().string(), text_of(entry.path()));
    package.emplace(type.name, type);
  }
  for (const std::string name : {"AlarmEvent", "Command", "CommandResult", "ProcessState"}) {
    const auto hash = type_hash(package, "orbwatch_msgs/msg/" + name);
    ASSERT_TRUE(hash) << hash.error().message;
    EXPECT_EQ(*hash, type_hash(ours, "orbwatch_msgs/msg/" + name).value()) << name;
  }
}

TEST(MessagePackage, KeepsTheRulesOfRos2) {
  static const std::regex kField("[a-z](_?[a-z0-9])*");  // rosidl_adapter, VALID_FIELD_NAME_PATTERN
  static const std::regex kType("msg/[A-Z][A-Za-z0-9]*\\.msg");
  const auto files = message_package().value();
  for (const PackageFile& file : files) {
    if (!file.path.ends_with(".msg")) continue;
    EXPECT_TRUE(std::regex_match(file.path, kType)) << file.path;
    for (const Member& field : fields_of(file.text)) {
      EXPECT_TRUE(std::regex_match(field.name, kField)) << file.path << ": " << field.name;
    }
  }
}

TEST(MessagePackage, SaysWhatASignalIsAndItsUnit) {
  const std::string signals = text_of(kCommitted / "msg/Signals.msg");
  EXPECT_NE(signals.find("float64 hot_spot_length  # Long axis of the ellipse with its second "
                         "moments [mm]\n"),
            signals.npos);
}

TEST(MessagePackage, WritesEveryKindOfField) {
  MessageType type{"a/msg/T", {"about it"}, std::vector<MessageField>(4)};
  type.fields[0] = {"k", FieldKind::Double, FieldCount::Array, 9, 0, "", ""};
  type.fields[1] = {"n", FieldKind::BoundedString, FieldCount::One, 0, 256, "", ""};
  type.fields[2] = {"d", FieldKind::Byte, FieldCount::Sequence, 0, 0, "", ""};
  type.fields[3] = {"t", FieldKind::Nested, FieldCount::One, 0, 0, "b/msg/Other", "of b"};
  EXPECT_EQ(msg_text(type),
            "# about it\n\nfloat64[9] k\nstring<=256 n\nbyte[] d\nb/Other t  # of b\n");
}

}  // namespace
}  // namespace orbwatch::app
