// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <condition_variable>
#include <filesystem>
#include <fstream>
#include <mutex>
#include <nlohmann/json.hpp>
#include <thread>
#include <vector>

#include "app/recent_log.h"
#include "tests/app/ports/web/served.h"
#include "tests/support/temporary_folder.h"

/// Tests commands over the server, up to the handler shared by all interfaces.
namespace orbwatch::app::web::tests {
namespace {

using nlohmann::json;
using testing::HasSubstr;

class Commands : public Served {
 protected:
  void SetUp() override {
    WebSettings settings = on_a_free_port();
    settings.request_timeout = timeout;
    WebContext context = make_context();
    context.commands.record = record;
    context.commands.handler = [this](const Command& command) { return handle(command); };
    context.program.log = std::make_shared<RecentLog>();
    context.tables = [] { return std::vector<InterfaceTable>(); };
    sink = std::make_unique<WebSink>(settings, context);
    ASSERT_TRUE(sink->start());
  }
  CommandResult handle(const Command& command) {
    std::unique_lock lock(mutex);
    received.push_back(command);
    changed.notify_all();
    changed.wait(lock, [this] { return !is_held; });
    return result;
  }
  void release() {
    const std::lock_guard lock(mutex);
    is_held = false;
    changed.notify_all();
  }
  std::size_t count() {
    const std::lock_guard lock(mutex);
    return received.size();
  }
  Answer post(const std::string& name, const std::string& body,
              const std::string& headers = kJsonHeader) const {
    return request(port(), "POST", "/api/v1/command/" + name, headers, body);
  }

  std::chrono::milliseconds timeout{10000};
  std::shared_ptr<CommandRecord> record = std::make_shared<CommandRecord>();
  std::mutex mutex;
  std::condition_variable changed;
  bool is_held = false;
  CommandResult result = CommandResult::Done;
  std::vector<Command> received;
};

/// A body with the least value of each argument.
json least(const CommandInfo& info) {
  json body = json::object();
  for (std::size_t i = 0; i < info.argument_count(); ++i) {
    body[std::string(info.arguments[i].name)] = info.arguments[i].minimum;
  }
  return body;
}

TEST_F(Commands, EachOfTheListReachesTheHandler) {
  for (const CommandInfo& info : kCommands) {
    const Answer answer = post(std::string(info.name), least(info).dump());
    EXPECT_EQ(answer.status, 200) << info.name << answer.body;
    EXPECT_EQ(json::parse(answer.body)["result_text"], "done");
    ASSERT_FALSE(received.empty());
    EXPECT_EQ(received.back().code, info.code);
    EXPECT_EQ(received.back().giver.name(), "over HTTP");
    for (std::size_t i = 0; i < info.argument_count(); ++i) {
      EXPECT_EQ(received.back().arguments[i], info.arguments[i].minimum) << info.name;
    }
  }
  EXPECT_EQ(received.size(), kCommands.size());
  EXPECT_EQ(record->entries().back().id, (CommandId{CommandRunner::kClient, kCommands.size()}));
  EXPECT_EQ(sink->statistics().commands_done, kCommands.size());
}

TEST_F(Commands, TheHandlersResultIsAnswered) {
  for (const auto& [told, status] :
       {std::pair{CommandResult::ArgumentOutOfRange, 400}, std::pair{CommandResult::Busy, 503},
        std::pair{CommandResult::NotPossible, 409}}) {
    result = told;
    const Answer answer = post("start", "{}");
    EXPECT_EQ(answer.status, status);
    EXPECT_EQ(json::parse(answer.body)["result"], static_cast<int>(told));
    EXPECT_EQ(json::parse(answer.body)["result_text"], operator_text(told));
  }
  EXPECT_EQ(sink->statistics().commands_refused, 3U);
}

TEST_F(Commands, WhatIsWrongReachesNobody) {
  EXPECT_EQ(post("start_everything", "{}").status, 404);
  EXPECT_EQ(post("", "{}").status, 404);
  EXPECT_EQ(get(port(), "/api/v1/command/start").status, 405);
  EXPECT_EQ(post("select_recipe", R"({"recipe": 0})").status, 400);
  EXPECT_THAT(post("select_recipe", R"({"recipe": 0})").body, HasSubstr("1 to 65535"));
  EXPECT_EQ(post("select_recipe", "recipe=1").status, 400);
  EXPECT_TRUE(received.empty());
}

TEST_F(Commands, ForeignPagesReachNobody) {
  const std::string port_text = ":" + std::to_string(port());
  // Browsers send forms of these types without a preflight.
  for (const char* type :
       {"", "Content-Type: text/plain\r\n", "Content-Type: application/x-www-form-urlencoded\r\n",
        "Content-Type: multipart/form-data; boundary=x\r\n",
        "Content-Type: application/jsonx\r\n"}) {
    EXPECT_EQ(post("start", "{}", type).status, 415) << type;
  }
  for (const char* page :
       {"Origin: http://evil.example\r\n", "Origin: null\r\n", "Origin: http://127.0.0.1:1\r\n",
        "Origin: http://127.0.0.1.evil.example\r\n", "Sec-Fetch-Site: cross-site\r\n",
        "Sec-Fetch-Site: same-site\r\n"}) {
    EXPECT_EQ(post("start", "{}", kJsonHeader + page).status, 403) << page;
  }
  EXPECT_EQ(request(port(), "OPTIONS", "/api/v1/command/start").status, 405);
  EXPECT_TRUE(received.empty());
  for (const char* own : {"Origin: http://127.0.0.1\r\n", "Sec-Fetch-Site: same-origin\r\n"}) {
    EXPECT_EQ(post("start", "{}", kJsonHeader + own).status, 200) << own;
  }
}

TEST_F(Commands, AHeldHandlerDelaysNoOtherRequest) {
  is_held = true;
  std::vector<std::unique_ptr<Client>> clients;
  const auto send = [&] {
    clients.push_back(std::make_unique<Client>(port()));
    clients.back()->send(request_text("POST", "/api/v1/command/start", kJsonHeader, "{}"));
  };
  send();
  ASSERT_TRUE(eventually([&] { return count() == 1; }));
  EXPECT_EQ(get(port(), "/api/v1/status").status, 200);
  release();
  EXPECT_EQ(clients.front()->answer().status, 200);
}

/// Returns whether this process has a thread of that name.
bool has_thread(const std::string& name) {
  for (const auto& task : std::filesystem::directory_iterator("/proc/self/task")) {
    std::ifstream in(task.path() / "comm");
    std::string found;
    if (std::getline(in, found) && found == name) return true;
  }
  return false;
}

/// The command stops everything as soon as it is done, like restart.
TEST_F(Commands, WhatIsBeingDoneIsAnsweredAlthoughTheServerEnds) {
  is_held = true;
  Client client(port());
  client.send(request_text("POST", "/api/v1/command/restart", kJsonHeader, "{}"));
  ASSERT_TRUE(eventually([&] { return count() == 1; }));
  std::jthread end([this] { sink->stop(); });
  ASSERT_TRUE(eventually([] { return !has_thread("web"); })) << "its end has not begun";
  release();
  const Answer answer = client.answer();
  EXPECT_EQ(answer.status, 200) << answer.body;
  EXPECT_THAT(answer.body, HasSubstr("done"));
}

class HurriedCommands : public Commands {
 protected:
  HurriedCommands() { timeout = std::chrono::milliseconds(300); }
};

/// Its client got a timeout answer, so the command must not be executed later.
TEST_F(HurriedCommands, ACommandThatWaitedTooLongIsNotCarriedOut) {
  is_held = true;
  Client first(port()), second(port());
  for (const Client* client : {&first, &second}) {
    client->send(request_text("POST", "/api/v1/command/start", kJsonHeader, "{}"));
    ASSERT_TRUE(eventually([&] { return count() == 1; }));
  }
  EXPECT_EQ(second.answer().status, 503);
  release();
  EXPECT_EQ(first.answer().status, 200) << "what was begun is answered by its result";
  EXPECT_EQ(post("stop", "{}").status, 200);
  EXPECT_EQ(count(), 2U) << "the second start was carried out";
  EXPECT_EQ(received.back().code, CommandCode::Stop);
}

TEST(CommandNumbers, GoOnAfterARestart) {
  const orbwatch::tests::TemporaryFolder folder;
  for (std::uint64_t run = 1; run <= 3; ++run) {
    const auto record = std::make_shared<CommandRecord>(folder.path());
    WebContext context = make_context();
    context.commands.record = record;
    context.commands.handler = [](const Command&) { return CommandResult::Done; };
    WebSink sink(on_a_free_port(), context);
    ASSERT_TRUE(sink.start());
    EXPECT_EQ(request(sink.port(), "POST", "/api/v1/command/start", kJsonHeader, "{}").status, 200);
    EXPECT_EQ(record->entries().back().id.number, run);
  }
}

TEST_F(Commands, DescriptionNamesEveryRouteCommandAndFigure) {
  const json description = json::parse(get(port(), "/api/v1/openapi.json").body);
  EXPECT_EQ(description["openapi"], "3.0.3");
  const json& paths = description["paths"];
  for (const CommandInfo& info : kCommands) {
    const std::string path = "/api/v1/command/" + std::string(info.name);
    ASSERT_TRUE(paths.contains(path)) << path;
    const json& schema =
        paths[path]["post"]["requestBody"]["content"]["application/json"]["schema"];
    ASSERT_EQ(schema["properties"].size(), info.argument_count());
    for (std::size_t i = 0; i < info.argument_count(); ++i) {
      const json& argument = schema["properties"][std::string(info.arguments[i].name)];
      EXPECT_EQ(argument["maximum"], info.arguments[i].maximum);
    }
  }
  // Every described route is served, and is described as served.
  for (const auto& [path, methods] : paths.items()) {
    for (const auto& [method, operation] : methods.items()) {
      const int status = request(port(), method == "get" ? "GET" : "POST", path).status;
      EXPECT_NE(status, 405) << path;
      const bool needs_argument =
          operation.contains("parameters") && operation["parameters"][0]["required"];
      const bool misses_one = status == 404 || (method == "get" && status == 400);
      EXPECT_EQ(misses_one, needs_argument) << path << ": " << status;
    }
  }
  sink->accept(app::tests::make_status());
  const json status = json::parse(get(port(), "/api/v1/status").body);
  const json& schema = description["components"]["schemas"]["Status"]["properties"];
  for (const auto& [kind, value] : status.items()) {
    ASSERT_TRUE(schema.contains(kind)) << kind;
    const json& described = value.is_array() ? schema[kind]["items"] : schema[kind];
    const json& part = value.is_array() ? value.front() : value;
    if (!part.is_object()) continue;
    for (const auto& [figure, number] : part.items()) {
      ASSERT_TRUE(described["properties"].contains(figure)) << kind << "." << figure;
      const json& type = described["properties"][figure]["type"];
      EXPECT_TRUE(number.is_null() || (number.is_number() && type == "number") ||
                  (number.is_number_integer() && type == "integer") ||
                  (number.is_boolean() && type == "boolean") ||
                  (number.is_string() && type == "string"))
          << kind << "." << figure << " " << number;
    }
  }
}

}  // namespace
}  // namespace orbwatch::app::web::tests
