// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/access/audit/audit.h"

#include <gmock/gmock.h>
#include <sys/stat.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/app/ports/web/access/access_served.h"
#include "tests/support/temporary_folder.h"

namespace orbwatch::app::web::tests {
namespace {

using nlohmann::json;
using orbwatch::tests::TemporaryFolder;

json entries(const Audit& audit, std::size_t most = 100000) {
  return json::parse(json_text(audit.newest(most)));
}

Audit::Entry numbered(int number) {
  return {Utc(std::chrono::seconds(1'800'000'000)),
          "kim",
          "10.0.0.1",
          std::to_string(number),
          "",
          "",
          "done"};
}

TEST(Audit, HoldsWhatWasNotedAcrossARestart) {
  const TemporaryFolder folder;
  Audit(folder.path())
      .note({Utc(std::chrono::seconds(1'800'000'000)), "kim", "10.0.0.1", "set_user", "lee: viewer",
             "lee: operator", "done"});
  Audit(folder.path()).note(numbered(2));
  const json all = entries(Audit(folder.path()));
  ASSERT_EQ(all.size(), 2U);
  EXPECT_EQ(all[0], (json{{"time", "2027-01-15T08:00:00.000000000Z"},
                          {"who", "kim"},
                          {"from", "10.0.0.1"},
                          {"what", "set_user"},
                          {"before", "lee: viewer"},
                          {"after", "lee: operator"},
                          {"result", "done"}}));
  EXPECT_EQ(all[1]["what"], "2");
  std::string line;
  std::getline(std::ifstream(folder / "audit.jsonl") >> std::ws, line);
  EXPECT_EQ(line, R"({"time":"2027-01-15T08:00:00.000000000Z","who":"kim","from":"10.0.0.1",)"
                  R"("what":"set_user","before":"lee: viewer","after":"lee: operator",)"
                  R"("result":"done"})");
  struct stat about {};
  ASSERT_EQ(::stat((folder / "audit.jsonl").c_str(), &about), 0);
  EXPECT_EQ(about.st_mode & 07777U, 0600U);
}

TEST(Audit, IsBoundedAndKeepsTheNewest) {
  const TemporaryFolder folder;
  Audit audit(folder.path());
  Audit::Entry large = numbered(0);
  large.after = std::string(AuditFile::kMostBytes / 50, 'x');
  constexpr int kNoted = 170;
  for (int i = 0; i < kNoted; ++i) {
    large.what = std::to_string(i);
    audit.note(large);
  }
  EXPECT_EQ(folder.files(), 2);
  for (const auto& entry : std::filesystem::directory_iterator(folder.path())) {
    EXPECT_LE(entry.file_size(), AuditFile::kMostBytes);
  }
  const json all = entries(audit);
  EXPECT_GT(all.size(), 49U);
  EXPECT_EQ(all.back()["what"], std::to_string(kNoted - 1));
  for (std::size_t i = 0; i < all.size(); ++i) {
    EXPECT_EQ(all[i]["what"], std::to_string(static_cast<std::size_t>(kNoted) - all.size() + i));
  }
  EXPECT_EQ(entries(audit, 3).front()["what"], std::to_string(kNoted - 3));
}

TEST(Audit, ALineThatWasCutTakesNoOtherWithIt) {
  const TemporaryFolder folder;
  Audit audit(folder.path());
  audit.note(numbered(1));
  audit.note(numbered(2));
  const auto file = folder / "audit.jsonl";
  std::filesystem::resize_file(file, std::filesystem::file_size(file) - 10);
  audit.note(numbered(3));
  const json all = entries(audit);
  ASSERT_EQ(all.size(), 2U);
  EXPECT_EQ(all[0]["what"], "1");
  EXPECT_EQ(all[1]["what"], "3");
}

Audit::Entry refused_login(int number, const std::string& from) {
  Audit::Entry entry = numbered(number);
  entry.who.clear();
  entry.from = from;
  entry.what = "login";
  entry.result = "refused";
  entry.time += std::chrono::seconds(number);
  return entry;
}

TEST(Audit, RefusedClientsHaveFilesOfTheirOwnAndFewOfTheLinesShown) {
  const TemporaryFolder folder;
  Audit audit(folder.path());
  audit.note(numbered(1));
  for (int i = 0; i < 5000; ++i) {
    audit.note_refused(
        refused_login(i, "10.1." + std::to_string(i / 256) + "." + std::to_string(i % 256)));
  }
  audit.write_all();
  const json all = entries(audit, 100);
  EXPECT_EQ(all.size(), Audit::kMostRefusedShown + 1);
  EXPECT_EQ(all.front()["what"], "1");
  EXPECT_EQ(all.back()["from"], "(others)");
  EXPECT_LT(std::filesystem::file_size(folder / "audit-refused.jsonl"), 200'000U);
  EXPECT_LT(std::filesystem::file_size(folder / "audit.jsonl"), 200U);
}

TEST(Audit, ShowsEachUsersNewestHoweverManyAnotherOneHas) {
  const TemporaryFolder folder;
  Audit audit(folder.path());
  Audit::Entry of_lee = numbered(0);
  of_lee.who = "lee";
  audit.note(of_lee);
  for (int number = 1; number <= 100; ++number) audit.note(numbered(number));
  const json shown = entries(audit, 20);
  ASSERT_EQ(shown.size(), 20U);
  EXPECT_EQ(shown[0]["who"], "lee");
  EXPECT_EQ(shown[1]["what"], "82");
  EXPECT_EQ(shown[19]["what"], "100");
}

/// A command over DDS, of a client with this number.
Audit::Entry dds_command(const std::string& what, int number, std::chrono::seconds time) {
  Audit::Entry entry = numbered(number);
  entry.time += time;
  entry.who.clear();
  entry.from = "over DDS, client " + std::to_string(number);
  entry.what = what;
  return entry;
}

TEST(Audit, CommandsOfOtherInterfacesAreInFilesOfTheirOwnWithAShareForEach) {
  const TemporaryFolder folder;
  Audit audit(folder.path());
  audit.note(numbered(0));
  audit.note_command(dds_command("start", 1, std::chrono::hours(1)), "over DDS");
  constexpr int kGiven = 100;
  for (int i = 2; i <= kGiven; ++i) {
    audit.note_command(dds_command("trigger", i, std::chrono::hours(i)), "over DDS");
  }
  EXPECT_EQ(folder.files(), 1) << "commands do not wait for the disk";
  audit.write_due(Repetitions::Time(std::chrono::seconds(1'800'000'000)));
  EXPECT_EQ(folder.files(), 2);
  const json all = entries(audit, 200);
  ASSERT_EQ(all.size(), Audit::kMostCommandsShown + 1);
  EXPECT_EQ(all[0]["who"], "kim");
  EXPECT_EQ(all[1]["what"], "start");
  EXPECT_EQ(all.back()["from"], "over DDS, client " + std::to_string(kGiven));
  EXPECT_EQ(entries(Audit(folder.path()), 200), all);
}

TEST(Audit, CommandsOfOneInterfaceAreOfOneKindWhateverTheNumbersOfTheirClients) {
  const TemporaryFolder folder;
  Audit audit(folder.path());
  constexpr int kGiven = 30;
  for (int i = 0; i < kGiven; ++i) {
    audit.note_command(dds_command("start", i, std::chrono::seconds(i)), "over DDS");
  }
  audit.note_command(dds_command("start", kGiven, std::chrono::seconds(kGiven)), "over Modbus");
  audit.write_all();
  const json all = entries(audit);
  ASSERT_EQ(all.size(), Audit::kFree + 2) << all.dump(1);
  EXPECT_EQ(all[Audit::kFree]["result"], "done, 10 more");
  EXPECT_EQ(all.back()["result"], "done");
}

TEST(Audit, CountsOfANetworkOfIpv6AreOne) {
  const TemporaryFolder folder;
  Audit audit(folder.path());
  for (int i = 0; i < 100; ++i) audit.note_refused(refused_login(i, "fd00::" + std::to_string(i)));
  audit.write_due(Repetitions::Time(std::chrono::seconds(1'800'000'100)));
  EXPECT_EQ(entries(audit).size(), 1U);
  audit.write_due(Repetitions::Time(std::chrono::seconds(1'800'000'700)));
  ASSERT_EQ(entries(audit).size(), 2U);
  EXPECT_EQ(entries(audit)[1]["result"], "refused, 99 more");
}

class ShownAudit : public AccessServed {
 protected:
  void SetUp() override {
    AccessServed::SetUp();
    add_one_of_each_role();
  }
  json shown() const {
    return json::parse(get(port(), "/api/v1/audit", by_token(Role::Administrator)).body)["entries"];
  }
};

class AuditServed : public ShownAudit {
 protected:
  void SetUp() override {
    ShownAudit::SetUp();
    handler = [this](const Command& command) {
      giver = command.giver;
      return command.code == CommandCode::Stop ? CommandResult::NotPossible : CommandResult::Done;
    };
    start();
  }

  Giver giver;  ///< origin of the newest command; read after its answer
};

TEST_F(AuditServed, SaysWhoDidWhat) {
  const std::string admin = session_of("administrator") + kPageHeaders;
  EXPECT_EQ(login("viewer", "not the password").status, 401);
  EXPECT_EQ(login("my-password-in-the-wrong-field", "x").status, 401);
  EXPECT_EQ(
      post("/api/v1/command/select_view", R"({"view":1})", by_token(Role::Operator) + kJsonHeader)
          .status,
      200);
  EXPECT_EQ(post("/api/v1/command/stop", "{}", by_token(Role::Operator) + kJsonHeader).status, 409);
  EXPECT_EQ(giver.name(), shown().back()["who"]) << "what is carried out has the same name";
  EXPECT_EQ(
      post("/api/v1/set_user",
           json{{"user", "viewer"}, {"role", "operator"}, {"password", kPassword}}.dump(), admin)
          .status,
      200);
  EXPECT_EQ(post("/api/v1/remove_user", R"({"user":"viewer"})", admin).status, 200);
  EXPECT_EQ(post("/api/v1/create_token", R"({"name":"plc","role":"viewer"})", admin).status, 200);
  const json all = shown();
  ASSERT_EQ(all.size(), 8U) << all.dump(1);
  const auto expect = [&](std::size_t i, const char* who, const char* what, const char* before,
                          const char* after, const char* result) {
    EXPECT_EQ(all[i]["who"], who) << all[i];
    EXPECT_EQ(all[i]["what"], what) << all[i];
    EXPECT_EQ(all[i]["before"], before) << all[i];
    EXPECT_EQ(all[i]["after"], after) << all[i];
    EXPECT_EQ(all[i]["result"], result) << all[i];
    EXPECT_EQ(all[i]["from"], "127.0.0.1");
  };
  expect(0, "administrator", "login", "", "administrator: administrator", "done");
  expect(1, "", "login", "", "viewer: viewer", "refused");
  expect(2, "", "login", "", "", "refused");
  expect(3, "operator", "select_view", "", R"({"view":1})", "done");
  expect(4, "operator", "stop", "", "", "not possible with this configuration");
  expect(5, "administrator", "set_user", "viewer: viewer", "viewer: operator, another password",
         "done");
  expect(6, "administrator", "remove_user", "viewer: operator", "", "done");
  expect(7, "administrator", "create_token", "", "plc: viewer", "done");
}

TEST_F(AuditServed, GuessesAreNotedOnceAndCounted) {
  for (int i = 0; i < 30; ++i) login("administrator", "a wrong guess");
  const json all = shown();
  ASSERT_EQ(all.size(), 2U) << all.dump(1);
  EXPECT_EQ(all[0]["result"], "refused");
  EXPECT_EQ(all[1]["result"], "refused, 29 more");
  EXPECT_EQ(all[1]["after"], "administrator: administrator");
}

/// Neither the disk nor the desk is needed: `busy` would give 503.
TEST_F(AuditServed, WhoHasNoAccountPushesNothingOut) {
  const std::string body = json{{"code", "AAAA-AAAA"}, {"password", kPassword}}.dump();
  std::map<int, int> answers;
  constexpr int kSent = 300;
  for (int i = 0; i < kSent; ++i) {
    ++answers[post("/api/v1/set_first_password", body, kPageHeaders).status];
  }
  EXPECT_EQ(answers, (std::map<int, int>{{409, 20}, {429, kSent - 20}}));
  const json all = shown();
  ASSERT_EQ(all.size(), 2U) << all.dump(1);
  EXPECT_EQ(all[1]["result"], "refused, 299 more");
  EXPECT_FALSE(std::filesystem::exists(folder / "audit.jsonl")) << "a file of its own";
}

TEST_F(AuditServed, TurningAViewAgainAndAgainIsCounted) {
  const std::string headers = by_token(Role::Operator) + kJsonHeader;
  for (int i = 0; i < 60; ++i) {
    const std::string view = json{{"view", i % 2}}.dump();
    ASSERT_EQ(post("/api/v1/command/select_view", view, headers).status, 200);
  }
  ASSERT_EQ(post("/api/v1/command/stop", "{}", headers).status, 409);
  const json all = shown();
  ASSERT_EQ(all.size(), Audit::kFree + 2) << all.dump(1);
  EXPECT_EQ(all[Audit::kFree]["result"], "not possible with this configuration");
  EXPECT_EQ(all.back()["result"], "done, 40 more");
  EXPECT_EQ(all.back()["after"], R"({"view":1})");
}

TEST_F(AuditServed, LoggingOutWithoutASessionIsNoAct) {
  const std::string headers = by_token(Role::Viewer) + kPageHeaders;
  EXPECT_EQ(post("/api/v1/logout", "{}", headers).status, 200);
  EXPECT_EQ(post("/api/v1/logout", "{}", headers + "Cookie: orbwatch_session=x\r\n").status, 200);
  EXPECT_EQ(shown().size(), 0U);
  const std::string session = session_of("viewer");
  EXPECT_EQ(post("/api/v1/logout", "{}", session + kPageHeaders).status, 200);
  EXPECT_EQ(shown().back()["what"], "logout");
}

/// Texts of refused requests are the client's: neither their number nor their size fills the file.
TEST_F(AuditServed, RefusedRequestsOfAViewerPushNothingOut) {
  ASSERT_EQ(post("/api/v1/create_token", R"({"name":"plc","role":"viewer"})",
                 by_token(Role::Administrator) + kJsonHeader)
                .status,
            200);
  const std::string viewer = by_token(Role::Viewer) + kJsonHeader;
  for (int i = 0; i < 60; ++i) {
    const std::string event(60'000, "abc"[i % 3]);
    const std::string body = json{{"event", event}, {"format", "csv"}}.dump();
    ASSERT_EQ(post("/api/v1/export_recording", body, viewer).status, 404) << "no recorder";
  }
  const json all = shown();
  ASSERT_EQ(all.size(), 1 + Audit::kFree + 1);
  EXPECT_EQ(all[0]["what"], "create_token");
  EXPECT_EQ(all[1]["after"], std::string(100, 'a') + " csv");
  EXPECT_EQ(all.back()["result"], "refused, 40 more");
  EXPECT_LT(std::filesystem::file_size(folder / "audit.jsonl"), 100'000U);
  EXPECT_FALSE(std::filesystem::exists(folder / "audit.1.jsonl"));
}

/// Changes of different users are recorded separately, however many there are.
TEST_F(AuditServed, EveryUserThatIsAddedIsNoted) {
  const std::string admin = by_token(Role::Administrator) + kJsonHeader;
  constexpr int kAdded = 30;
  for (int i = 0; i < kAdded; ++i) {
    const json token{{"name", "program-" + std::to_string(i)}, {"role", "viewer"}};
    ASSERT_EQ(post("/api/v1/create_token", token.dump(), admin).status, 200);
  }
  EXPECT_EQ(shown().size(), static_cast<std::size_t>(kAdded));
}

/// A sink beside interfaces without accounts, whose commands pass through the same record.
class OtherInterfaces : public ShownAudit {
 protected:
  void start_beside() {
    WebContext context = make_context();
    context.state_folder = state_folder;
    context.commands.record = record;
    context.commands.handler = [](const Command&) { return CommandResult::Done; };
    serve(context);
  }
  void give(const CommandId& id, const Command& command,
            CommandResult result = CommandResult::Done) const {
    EXPECT_EQ(record->carry_out(id, command, [result](const Command&) { return result; }), result);
  }

  const std::shared_ptr<CommandRecord> record = std::make_shared<CommandRecord>();
};

TEST_F(OtherInterfaces, EachCommandIsNotedOnceWithItsInterface) {
  start_beside();
  const Giver plc("over Modbus");
  give({kPlcClient, 7}, {CommandCode::SelectRecipe, {2}, plc});
  give({4711, 1}, {CommandCode::Stop, {}, Giver("over DDS")}, CommandResult::NotPossible);
  give({kPlcClient, 8}, {static_cast<CommandCode>(999), {}, plc}, CommandResult::UnknownCommand);
  ASSERT_EQ(post("/api/v1/command/start", "{}", by_token(Role::Operator) + kJsonHeader).status,
            200);
  give({kPlcClient, 9}, {CommandCode::Trigger, {}, plc});
  json all;
  ASSERT_TRUE(eventually([&] {
    all = shown();
    return !all.empty() && all.back()["what"] == "trigger";
  })) << all.dump(1);
  ASSERT_EQ(all.size(), 5U) << all.dump(1);
  const auto expect = [&](std::size_t i, const char* who, const char* from, const char* what,
                          const char* after, const char* result) {
    EXPECT_EQ(all[i]["who"], who) << all[i];
    EXPECT_EQ(all[i]["from"], from) << all[i];
    EXPECT_EQ(all[i]["what"], what) << all[i];
    EXPECT_EQ(all[i]["before"], "") << all[i];
    EXPECT_EQ(all[i]["after"], after) << all[i];
    EXPECT_EQ(all[i]["result"], result) << all[i];
  };
  expect(0, "", "over Modbus", "select_recipe", R"({"recipe":2})", "done");
  expect(1, "", "over DDS, client 4711", "stop", "", "not possible with this configuration");
  expect(2, "", "over Modbus", "unknown command", "999", "unknown command");
  expect(3, "operator", "127.0.0.1", "start", "", "done");
  expect(4, "", "over Modbus", "trigger", "", "done");
}

TEST_F(OtherInterfaces, TheLastCommandsAreNotedWhenTheSinkStops) {
  start_beside();
  give({kPlcClient, 7}, {CommandCode::Stop, {}, Giver("over Modbus")});
  sink->stop();
  const json all = entries(Audit(state_folder));
  ASSERT_EQ(all.size(), 1U);
  EXPECT_EQ(all[0]["what"], "stop");
}

TEST_F(OtherInterfaces, CommandsThatCouldNotWaitAreNotedAsANumber) {
  constexpr std::uint64_t kLost = 44;
  for (std::uint64_t number = 1; number <= CommandRecord::kMostUnaudited + kLost; ++number) {
    give({kPlcClient, number}, {CommandCode::Stop, {}, Giver("over Modbus")});
  }
  start_beside();
  json lost;
  ASSERT_TRUE(eventually([&] {
    for (const json& entry : shown()) {
      if (entry["what"] == "unrecorded commands") lost = entry;
    }
    return !lost.is_null();
  }));
  EXPECT_EQ(lost["before"], "0");
  EXPECT_EQ(lost["after"], "44");
  EXPECT_EQ(lost["result"], "too many commands at a time");
}

}  // namespace
}  // namespace orbwatch::app::web::tests
