// SPDX-License-Identifier: Apache-2.0
#include "app/ports/dds/security/access_documents.h"

#include <gmock/gmock.h>

#include "app/cli/keys/keystore.h"
#include "app/ports/dds/topics/topic_names.h"

#include <fnmatch.h>

namespace orbwatch::app::dds {
namespace {

using std::chrono::sys_days;
using std::chrono::sys_seconds;
using testing::ElementsAre;
using testing::HasSubstr;

/// Document with one grant, written by hand in the style of other products.
std::string document(const std::string& grant) {
  return "<?xml version=\"1.0\"?><dds xmlns:xsi=\"http://www.w3.org/2001/XMLSchema-instance\">"
         "<permissions><grant name=\"g\">" +
         grant + "</grant></permissions></dds>";
}

std::string dates(const std::string& from, const std::string& until) {
  return document("<validity><not_before>" + from + "</not_before><not_after>" + until +
                  "</not_after></validity>");
}

TEST(PermissionsTest, AreReadAsTheyWereWritten) {
  const Grant grant{"CN=plc",
                    {sys_days(std::chrono::January / 31 / 2026),
                     sys_seconds(std::chrono::seconds(2'000'000'001))},
                    {{3, 3}, {7, 9}},
                    {{"rt/a"}, {"rt/b", "rt/c/*"}}};
  const auto read = read_permissions(permissions_document(grant));
  ASSERT_TRUE(read) << read.error().message;
  ASSERT_EQ(read->size(), 1U);
  const Grant& again = read->front();
  EXPECT_EQ(again.subject, "CN=plc");
  EXPECT_EQ(again.validity.from, grant.validity.from);
  EXPECT_EQ(again.validity.until, grant.validity.until);
  EXPECT_THAT(again.topics.publish, ElementsAre("rt/a"));
  EXPECT_THAT(again.topics.subscribe, ElementsAre("rt/b", "rt/c/*"));
  for (int domain = 0; domain < 12; ++domain) {
    EXPECT_EQ(contains(again.domains, domain), domain == 3 || (domain >= 7 && domain <= 9));
  }
}

TEST(PermissionsTest, OfOtherProductsAreRead) {
  const auto read = read_permissions(document(
      "<subject_name>/C=DE/O=Mill AG/CN=plc</subject_name>"
      "<validity><not_before>2020-02-29T01:00:00.25+01:00</not_before>"
      "<not_after>2020-03-01T00:00:00Z</not_after></validity>"
      "<deny_rule><domains><id>5</id></domains><publish><topics><topic>x</topic></topics></publish>"
      "</deny_rule>"
      "<allow_rule><domains><id>1</id><id_range><min>4</min></id_range></domains>"
      "<subscribe><topics><topic>*</topic></topics></subscribe></allow_rule>"));
  ASSERT_TRUE(read) << read.error().message;
  const Grant* grant = find_grant(*read, "CN=plc,O=Mill AG,C=DE");
  ASSERT_TRUE(grant);
  EXPECT_EQ(find_grant(*read, "CN=plc,O=Mill,C=DE"), nullptr);
  EXPECT_EQ(find_grant(*read, "CN=other,O=Mill AG,C=DE"), nullptr);
  EXPECT_EQ(grant->validity.from, sys_seconds(sys_days(std::chrono::February / 29 / 2020)));
  EXPECT_EQ(grant->validity.until, sys_seconds(sys_days(std::chrono::March / 1 / 2020)));
  EXPECT_THAT(grant->topics.publish, ElementsAre());
  EXPECT_TRUE(contains(grant->domains, 1) && contains(grant->domains, 4) &&
              contains(grant->domains, 230));
  EXPECT_FALSE(contains(grant->domains, 0) || contains(grant->domains, 3));
}

/// A 32-bit time_t ends in January 2038.
TEST(PermissionsTest, DatesBeyondTheEndOf32BitAreReadAsTheyWereWritten) {
  const sys_seconds from(sys_days(std::chrono::July / 1 / 2045));
  const sys_seconds until(sys_days(std::chrono::December / 31 / 2105));
  const auto read =
      read_permissions(permissions_document({"CN=plc", {from, until}, {{3, 3}}, {{"rt/a"}, {}}}));
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(read->front().validity.from, from);
  EXPECT_EQ(read->front().validity.until, until);
}

TEST(PermissionsTest, RefusesWhatIsNone) {
  for (const std::string wrong : {"", "<", "<dds>", "<a></b>", "</a>", "text", "<a/><b/>"}) {
    EXPECT_FALSE(read_permissions(wrong)) << wrong;
  }
  for (const std::string wrong : {"", "soon", "2020-01-01", "2020-01-01T00:00:00X",
                                  "2020-01-01T00:00:00+1", "2020-13-01T00:00:00"}) {
    const auto read = read_permissions(dates("2020-01-01T00:00:00", wrong));
    // An element without text gives an empty text.
    ASSERT_FALSE(read) << wrong;
    EXPECT_THAT(read.error().message, HasSubstr("instead of a date"));
  }
  const auto lacking = read_permissions(
      document("<allow_rule><domains><id>one</id><id>-3</id><id>99999999999</id></domains>"
               "</allow_rule>"));
  ASSERT_TRUE(lacking);
  EXPECT_FALSE(contains(lacking->front().domains, 0) || contains(lacking->front().domains, 1));
}

TEST(GovernanceTest, IsForItsDomains) {
  const auto domains = governed_domains(governance_document({3, 5}, {"rt/a/*/*"}));
  ASSERT_TRUE(domains) << domains.error().message;
  EXPECT_TRUE(contains(*domains, 3) && contains(*domains, 5));
  EXPECT_FALSE(contains(*domains, 2) || contains(*domains, 6));
  EXPECT_FALSE(governed_domains("<dds"));
}

/// Matches topics by the rules of DDS Security 1.1, 9.4.1.3.2.3.
bool allows(const std::vector<std::string>& patterns, const std::string& topic) {
  return std::ranges::any_of(patterns, [&topic](const std::string& pattern) {
    return fnmatch(pattern.c_str(), topic.c_str(), 0) == 0;
  });
}

TEST(TopicAccessTest, IsWhatEachNeedsAndNoMore) {
  const std::string prefix = "cell_1/orbwatch";
  const TopicAccess appliance = cli::appliance_access(prefix);
  const TopicAccess reader = cli::reader_access(prefix);
  const TopicAccess controller = cli::controller_access(prefix);
  for (const std::string& topic :
       {image_topic(prefix, "front"), image_topic(prefix, "front") + "/compressed",
        radiometric_topic(prefix, "front"), process_state_topic(prefix), event_topic(prefix),
        command_result_topic(prefix), std::string("rt/diagnostics")}) {
    EXPECT_TRUE(allows(appliance.publish, topic)) << topic;
    EXPECT_TRUE(allows(reader.subscribe, topic)) << topic;
    EXPECT_TRUE(allows(controller.subscribe, topic)) << topic;
    EXPECT_FALSE(allows(appliance.subscribe, topic)) << topic;
    EXPECT_FALSE(allows(reader.publish, topic)) << topic;
    EXPECT_FALSE(allows(controller.publish, topic)) << topic;
  }
  const std::string command = command_topic(prefix);
  EXPECT_TRUE(allows(appliance.subscribe, command));
  EXPECT_TRUE(allows(controller.publish, command));
  EXPECT_FALSE(allows(reader.publish, command));
  for (const TopicAccess& access : {reader, controller}) {
    EXPECT_FALSE(allows(access.subscribe, command)) << "who reads requests has their key";
    EXPECT_FALSE(allows(access.subscribe, image_topic("other", "front")));
  }
}

}  // namespace
}  // namespace orbwatch::app::dds
