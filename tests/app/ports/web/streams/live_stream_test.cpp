// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/streams/live_stream.h"

#include <gmock/gmock.h>

#include <map>
#include <nlohmann/json.hpp>
#include <utility>

#include "tests/app/ports/web/served.h"
#include "tests/app/ports/web/streams/live_client.h"

namespace orbwatch::app::web::tests {
namespace {

using nlohmann::json;

TEST_F(Served, LiveStreamCarriesStatusAndEachViewThatIsNamed) {
  start();
  LiveClient client(port(), "/api/v1/live?view=front&view=wide&view=front");
  ASSERT_TRUE(client.head.starts_with("HTTP/1.1 200")) << client.head;
  const Message status = client.next("status");
  EXPECT_FALSE(status.head.contains("name"));
  EXPECT_EQ(json::parse(status.body)["cameras"][1]["name"], "thermal");
  show(1, 64, 48, 0);
  const Message first = client.next("view");
  EXPECT_EQ(first.head["name"], "front");
  EXPECT_EQ(first.head["number"], 1);
  EXPECT_GE(first.head["age_ms"], 0.0);
  EXPECT_TRUE(first.body.starts_with("\xff\xd8")) << "a JPEG";
  EXPECT_TRUE(first.body.ends_with("\xff\xd9")) << "whole";
  show(2, 64, 48, 1);
  EXPECT_EQ(client.next("view").head["name"], "wide");
  EXPECT_EQ(sink->statistics().streams, 1U);
  EXPECT_EQ(sink->statistics().pictures_sent, 2U) << "a view that is named twice is sent once";
}

TEST_F(Served, LiveStreamWithoutViewsReportsTheStatusAndAsksForNoPicture) {
  start();
  LiveClient client(port(), "/api/v1/live");
  const std::uint64_t first = client.next().head["number"];
  EXPECT_GT(client.next().head["number"], first) << "a busy reader gets the newest status";
  EXPECT_FALSE(sink->needs(0, hal::Clock::now()).jpeg);
}

TEST_F(Served, LiveStreamRefusesAViewThatThereIsNot) {
  start();
  const Answer answer = get(port(), "/api/v1/live?view=front&view=none");
  EXPECT_EQ(answer.status, 404);
  EXPECT_THAT(answer.body, testing::HasSubstr("there are: front, wide"));
}

TEST_F(Served, LiveStreamCountsAmongTheStreams) {
  WebSettings settings;
  settings.max_streams = 1;
  start(settings);
  LiveClient client(port(), "/api/v1/live");
  client.next();
  EXPECT_EQ(get(port(), "/api/v1/live").status, 503);
}

Item item_of(const std::string& text) {
  Item item;
  item.bytes = std::make_shared<const std::string>(text);
  item.stamp = hal::Clock::now();
  return item;
}

std::string read(LiveStream& stream, std::size_t most) {
  std::string out(most, '\0');
  out.resize(stream.read(out));
  return out;
}

/// A source that always has a new item does not block others, and a slow reader gets the newest
/// item of each.
TEST(LiveStream, TakesItsSourcesByTurnsAndTheNewestOfEach) {
  const auto a = std::make_shared<Feed>(), b = std::make_shared<Feed>();
  StreamCounts counts;
  LiveStream stream({{"a", a}, {"b", b}}, counts);
  stream.on_data([] {});
  std::map<std::string, int> messages;
  for (int round = 0; round < 10; ++round) {
    for (int n = 0; n < 3; ++n) a->publish(item_of("of a"));
    b->publish(item_of("of b"));
    const std::string message = read(stream, 4096);
    ++messages[message.substr(message.find('\n') + 1)];
  }
  EXPECT_EQ(messages["of a"], 5);
  EXPECT_EQ(messages["of b"], 5);
  EXPECT_EQ(counts.sent, 10U);
  EXPECT_EQ(counts.skipped, 22U + 5U);
}

TEST(LiveStream, IsTheSameInPiecesOfAnySize) {
  const auto feed = std::make_shared<Feed>();
  StreamCounts counts;
  LiveStream stream({{"a \"name\"\n", feed}}, counts);
  stream.on_data([] {});
  for (const std::size_t piece : {1U, 7U, 64U, 4096U}) {
    feed->publish(item_of(std::string(1000, 'x') + "\n"));
    std::string all;
    for (std::string part = read(stream, piece); !part.empty(); part = read(stream, piece)) {
      all += part;
    }
    const std::size_t end = all.find('\n');
    const json head = json::parse(all.substr(0, end));
    EXPECT_EQ(head["name"], "a \"name\"\n");
    EXPECT_EQ(head["bytes"], all.size() - end - 1);
    EXPECT_EQ(all.substr(end + 1), std::string(1000, 'x') + "\n");
  }
}

}  // namespace
}  // namespace orbwatch::app::web::tests
