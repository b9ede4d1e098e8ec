#include "app/dds/ros/idl_reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace orbwatch::app {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

MessageType read_one(const std::string& text, const std::string& name) {
  const auto types = read_idl(text);
  EXPECT_TRUE(types) << (types ? "" : types.error().message);
  if (!types || !types->contains(name)) return {};
  return types->at(name);
}

std::string refused(const std::string& text) {
  const auto types = read_idl(text);
  return types ? "" : types.error().message;
}

std::string in_module(const std::string& text) {
  return "module a { module msg { module dds_ {\n" + text + "\n}; }; };";
}

TEST(IdlReader, ReadsEveryBasicType) {
  for (const BasicType& basic : kBasicTypes) {
    const auto type = read_one(
        in_module("@final struct T_ { " + std::string(basic.idl) + " member; };"), "a/msg/T");
    ASSERT_EQ(type.fields.size(), 1U) << basic.idl;
    EXPECT_EQ(type.fields[0].name, "member");
    EXPECT_EQ(type.fields[0].kind, basic.kind);
    EXPECT_EQ(type.fields[0].count, FieldCount::One);
    EXPECT_TRUE(type.fields[0].nested.empty());
  }
}

TEST(IdlReader, ReadsArraysSequencesAndBoundedStrings) {
  const auto type =
      read_one(in_module("struct T_ { double k[9]; sequence<uint8> data; string<256> name; "
                         "sequence<string<7>> names; };"),
               "a/msg/T");
  ASSERT_EQ(type.fields.size(), 4U);
  EXPECT_EQ(type.fields[0].count, FieldCount::Array);
  EXPECT_EQ(type.fields[0].capacity, 9U);
  EXPECT_EQ(type.fields[1].count, FieldCount::Sequence);
  EXPECT_EQ(type.fields[1].kind, FieldKind::Uint8);
  EXPECT_EQ(type.fields[1].capacity, 0U);
  EXPECT_EQ(type.fields[2].kind, FieldKind::BoundedString);
  EXPECT_EQ(type.fields[2].string_capacity, 256U);
  EXPECT_EQ(type.fields[3].kind, FieldKind::BoundedString);
  EXPECT_EQ(type.fields[3].count, FieldCount::Sequence);
  EXPECT_EQ(type.fields[3].string_capacity, 7U);
}

TEST(IdlReader, FindsNestedTypesInTheirOwnAndInOtherModules) {
  const std::string text = in_module("struct Inner_ { int8 x; };") +
                           "module b { module msg { module dds_ { struct Inner_ { int8 y; };"
                           "struct T_ { Inner_ mine; sequence<a::msg::dds_::Inner_> theirs; }; "
                           "}; }; };";
  const auto type = read_one(text, "b/msg/T");
  ASSERT_EQ(type.fields.size(), 2U);
  EXPECT_EQ(type.fields[0].nested, "b/msg/Inner");
  EXPECT_EQ(type.fields[0].kind, FieldKind::Nested);
  EXPECT_EQ(type.fields[1].nested, "a/msg/Inner");
  EXPECT_EQ(type.fields[1].count, FieldCount::Sequence);
}

TEST(IdlReader, CommentsBelongToWhatTheyExplain) {
  const auto type = read_one("// about the file\n" + in_module(R"(// Two lines
// about the struct.
@final @topic
struct T_ {
  int8 a;  // of a
  // before b
  int8 b;  /* and behind */
  int8 c;
};)"),
                             "a/msg/T");
  EXPECT_THAT(type.comment, ElementsAre("Two lines", "about the struct."));
  ASSERT_EQ(type.fields.size(), 3U);
  EXPECT_EQ(type.fields[0].comment, "of a");
  EXPECT_EQ(type.fields[1].comment, "before b and behind");
  EXPECT_EQ(type.fields[2].comment, "");
}

TEST(IdlReader, ReadsWhatIsIncludedTwiceOnce) {
  const std::string twice =
      in_module("struct T_ { int8 a; };") + in_module("struct T_ { int8 a; };");
  EXPECT_EQ(read_one(twice, "a/msg/T").fields.size(), 1U);
}

TEST(IdlReader, RefusesWhatMessagesDoNotConsistOf) {
  EXPECT_THAT(refused("union U"), HasSubstr("line 1: \"union\" where \"struct\" should stand"));
  EXPECT_THAT(refused(in_module("struct T_ { int8 a; ")), HasSubstr("where"));
  EXPECT_THAT(refused("module a {"), HasSubstr("the end"));
  EXPECT_THAT(refused("}; "), HasSubstr("a module"));
  EXPECT_THAT(refused(in_module("struct T_ {\n long a; };")),
              HasSubstr("line 3: type \"long\" is not known"));
  EXPECT_THAT(refused(in_module("struct T_ { T_ a; };")), HasSubstr("not known"));
  EXPECT_THAT(refused(in_module("struct T_ { sequence<int8, 3> a; };")), HasSubstr("\",\""));
  EXPECT_THAT(refused(in_module("struct T_ { int8 a[0]; };")), HasSubstr("a number above 0"));
  EXPECT_THAT(refused(in_module("struct T_ { int8 a[3][3]; };")), HasSubstr("\"[\""));
  EXPECT_THAT(refused(in_module("struct T_ { int8 a[99999999999]; };")), HasSubstr("a number"));
  EXPECT_THAT(refused(in_module("struct T_ { int8 a /* open")), HasSubstr("the end"));
}

TEST(IdlReader, NamesTypesAsRos2Does) {
  EXPECT_EQ(ros_type_name("sensor_msgs::msg::dds_::Image_"), "sensor_msgs/msg/Image");
  EXPECT_EQ(ros_type_name("Plain"), "Plain");
  EXPECT_EQ(ros_type_name(""), "");
  EXPECT_EQ(ros_type_name("a_::B_"), "a_/B");
}

}  // namespace
}  // namespace orbwatch::app
