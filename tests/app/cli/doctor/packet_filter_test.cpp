// SPDX-License-Identifier: Apache-2.0
#include "app/cli/doctor/packet_filter.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

namespace orbwatch::app::cli::doctor {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

std::string ruleset(const std::string& objects) { return R"({"nftables": [)" + objects + "]}"; }

std::string chain(const std::string& hook, const std::string& policy,
                  const std::string& name = "input") {
  return R"({"chain": {"family": "inet", "table": "filter", "name": ")" + name + R"(", "hook": ")" +
         hook + R"(", "policy": ")" + policy + R"("}})";
}

std::string rule(const std::string& right, const std::string& statement = "accept",
                 const std::string& op = "==", const std::string& field = "dport") {
  return R"({"rule": {"expr": [{"match": {"op": ")" + op +
         R"(", "left": {"payload": {"protocol": "tcp", "field": ")" + field + R"("}}, "right": )" +
         right + R"(}}, {")" + statement + R"(": null}]}})";
}

TEST(PacketFilter, FindsChainsThatDropInput) {
  const auto filter = read_packet_filter(ruleset(
      chain("input", "drop") + "," + chain("input", "accept") + "," + chain("forward", "drop")));
  ASSERT_TRUE(filter);
  EXPECT_THAT(filter->closed_chains, ElementsAre("inet filter input"));
}

TEST(PacketFilter, FindsThePortsThatRulesName) {
  const auto filter = read_packet_filter(
      ruleset(rule("1502") + "," + rule(R"({"set": [22, {"range": [8000, 8100]}]})") + "," +
              rule(R"({"range": [100, 200]})", "jump") + "," + rule("23", "drop") + "," +
              rule("24", "accept", "!=") + "," + rule("25", "accept", "==", "sport")));
  ASSERT_TRUE(filter);
  for (const int port : {1502, 22, 8000, 8050, 8100, 100, 200}) {
    EXPECT_TRUE(names_port(filter->tcp, port)) << port;
  }
  for (const int port : {23, 24, 25, 7999, 8101, 99, 201}) {
    EXPECT_FALSE(names_port(filter->tcp, port)) << port;
  }
}

TEST(PacketFilter, KeepsTcpAndUdpApart) {
  std::string udp = rule("7400"), either = rule("99");
  udp.replace(udp.find("tcp"), 3, "udp");
  either.replace(either.find("tcp"), 3, "th");
  const auto filter = read_packet_filter(ruleset(udp + "," + rule("1502") + "," + either));
  ASSERT_TRUE(filter);
  EXPECT_TRUE(names_port(filter->udp, 7400) && names_port(filter->udp, 99));
  EXPECT_TRUE(names_port(filter->tcp, 1502) && names_port(filter->tcp, 99));
  EXPECT_FALSE(names_port(filter->tcp, 7400) || names_port(filter->udp, 1502));
}

TEST(PacketFilter, IsNoneOfOtherTexts) {
  for (const char* text : {"", "{", "[]", "7", "null", "{}", R"({"nftables": 7})",
                           R"({"nftables": {"chain": 1}})", "\xff\xfe"}) {
    EXPECT_FALSE(read_packet_filter(text)) << text;
  }
}

TEST(PacketFilter, ProposesNoWordsThatAShellWouldObey) {
  const auto filter = read_packet_filter(ruleset(chain("input", "drop", "a; reboot")));
  ASSERT_TRUE(filter);
  EXPECT_THAT(filter->closed_chains, IsEmpty());
}

TEST(PacketFilter, BearsWhateverRulesContain) {
  const auto odd = read_packet_filter(ruleset(
      R"(1, null, [], {"chain": []}, {"chain": {"hook": 5, "policy": "drop"}}, {"rule": 3},
         {"rule": {"expr": 3}}, {"rule": {"expr": [1, {"accept": null}, {"match": 7}]}},)" +
      rule("-1") + "," + rule("70000") + "," + rule("1.5") + "," + rule(R"({"range": [5, 1]})") +
      "," + rule(R"({"range": [1]})") + "," + rule(R"({"set": {"set": []}})") + "," +
      rule(R"({"set": [{"set": [80]}]})")));
  ASSERT_TRUE(odd);
  EXPECT_THAT(odd->tcp, IsEmpty());
  EXPECT_FALSE(read_packet_filter(std::string(100000, '[')));
  const std::string good = ruleset(chain("input", "drop") + "," + rule("1502"));
  std::mt19937 random(7);
  for (int i = 0; i < 2000; ++i) {
    std::string text = good;
    for (int change = 0; change < 3; ++change) {
      text[random() % text.size()] = static_cast<char>(random() % 256);
    }
    read_packet_filter(text);
  }
}

}  // namespace
}  // namespace orbwatch::app::cli::doctor
