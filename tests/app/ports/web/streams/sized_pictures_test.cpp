// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <opencv2/imgcodecs.hpp>
#include <vector>

#include "tests/app/ports/web/served.h"
#include "tests/app/ports/web/streams/live_client.h"

namespace orbwatch::app::web::tests {
namespace {

using testing::HasSubstr;

cv::Size size_of(const std::string& jpeg) {
  return cv::imdecode(std::vector<std::uint8_t>(jpeg.begin(), jpeg.end()), cv::IMREAD_COLOR).size();
}

/// Views of 64x48.
class SizedPictures : public Served {
 protected:
  /// A client that displays the view in a tile of this width.
  std::unique_ptr<LiveClient> tile(int width) const {
    const std::string target = "/api/v1/live?view=front&width=" + std::to_string(width);
    auto client = std::make_unique<LiveClient>(port(), target);
    client->next("status");  // it is among the readers
    return client;
  }
  std::uint64_t compressed() const { return sink->statistics().pictures_compressed; }
};

TEST_F(SizedPictures, AreTheSmallestThatFillTheTile) {
  start();
  for (const auto& [width, sent] : {std::pair{0, cv::Size(64, 48)},
                                    {16384, cv::Size(64, 48)},
                                    {49, cv::Size(64, 48)},
                                    {48, cv::Size(48, 36)},
                                    {32, cv::Size(32, 24)},
                                    {16, cv::Size(16, 12)},
                                    {1, cv::Size(16, 12)}}) {
    const auto client = tile(width);
    show(1);
    const Message picture = client->next("view");
    EXPECT_EQ(size_of(picture.body), sent) << width;
    EXPECT_EQ(picture.head["width"], 64) << "coordinates are those of the view";
    EXPECT_EQ(picture.head["height"], 48);
  }
}

/// Pixels are read by number and place: both must be the same for each client.
TEST_F(SizedPictures, HaveOneNumberInEverySize) {
  start();
  const auto large = tile(64);
  show(1);
  EXPECT_EQ(large->next("view").head["number"], 1);
  const auto small = tile(16);
  show(2);
  const Message picture = small->next("view");
  EXPECT_EQ(picture.head["number"], 2);
  EXPECT_EQ(large->next("view").head["number"], 2);
  EXPECT_EQ(sink->statistics().pictures_skipped, 0U)
      << "a picture from before its first reader is not one that it missed";
}

TEST_F(SizedPictures, AreCompressedOncePerSizeForAllClients) {
  start();
  std::vector<std::unique_ptr<LiveClient>> clients;
  for (const int width : {16, 15, 14, 32, 31, 30}) clients.push_back(tile(width));
  for (std::uint64_t number = 1; number <= 3; ++number) {
    show(number);
    for (const auto& client : clients) EXPECT_EQ(client->next("view").head["number"], number);
  }
  EXPECT_EQ(compressed(), 2U * 3U) << "two sizes, three pictures";
  EXPECT_EQ(sink->statistics().pictures_sent, 6U * 3U);
}

TEST_F(SizedPictures, OfDifferentViewsComeOverOneConnection) {
  start();
  LiveClient client(port(),
                    "/api/v1/live?view=front&width=16&view=wide&width=0&view=front&width=64");
  client.next("status");
  show(1, 64, 48, 0);
  EXPECT_EQ(size_of(client.next("view").body), cv::Size(16, 12)) << "the first of its widths";
  show(2, 64, 48, 1);
  EXPECT_EQ(size_of(client.next("view").body), cv::Size(64, 48));
}

TEST_F(SizedPictures, ComeAsSnapshotsAndMjpegToo) {
  start();
  Client player(port());
  player.send(request_text("GET", "/stream.mjpg?view=front&width=30"));
  player.take_until("\r\n\r\n");
  Answer answer;
  std::thread client([&] { answer = get(port(), "/snapshot.jpg?view=wide&width=16"); });
  show(1, 64, 48, 0);
  show(1, 64, 48, 1);
  client.join();
  EXPECT_EQ(size_of(answer.body), cv::Size(16, 12));
  EXPECT_THAT(answer.headers.at("X-Timestamp"), testing::StartsWith("20"));
  const std::string part = player.take_until("\r\n\r\n");
  const auto length = part.find("Content-Length: ");
  ASSERT_NE(length, std::string::npos) << part;
  EXPECT_EQ(size_of(player.take(std::stoul(part.substr(length + 16)))), cv::Size(32, 24));
}

TEST_F(SizedPictures, RefuseWidthsThatAreNone) {
  start();
  for (const char* width : {"-1", "16385", "1.5", "wide", "1e99", ""}) {
    for (const char* target : {"/api/v1/live", "/snapshot.jpg", "/stream.mjpg"}) {
      const Answer answer = get(port(), std::string(target) + "?view=front&width=" + width);
      EXPECT_EQ(answer.status, 400) << target << " " << width;
      EXPECT_THAT(answer.body, HasSubstr("must be a whole number, 0 to 16384")) << target;
    }
  }
  for (const char* query :
       {"view=front&view=wide&width=16", "view=front&width=16&width=16", "width=16"}) {
    const Answer answer = get(port(), std::string("/api/v1/live?") + query);
    EXPECT_EQ(answer.status, 400) << query;
    EXPECT_THAT(answer.body, HasSubstr("width must be there once for each view")) << query;
  }
}

}  // namespace
}  // namespace orbwatch::app::web::tests
