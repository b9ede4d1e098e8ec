// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/look_around/ball_pictures.h"

#include <gmock/gmock.h>

#include <mutex>
#include <nlohmann/json.hpp>
#include <thread>
#include <utility>
#include <vector>

#include "app/model/alignment/alignment.h"
#include "tests/app/ports/web/served.h"

namespace orbwatch::app::web::tests {
namespace {

using nlohmann::json;
using optics::ViewProjection;
using testing::ElementsAre;

/// Cameras whose pictures come when the test delivers them, or at once on another thread.
class Cameras : public AlignmentSource {
 public:
  explicit Cameras(bool delivers = false) : delivers_(delivers) {}

  AlignmentReport report(std::size_t camera) const override {
    AlignmentReport report;
    report.is_watched = std::ranges::count(unwatched, camera) == 0;
    return report;
  }
  std::optional<optics::Vec3> direction(std::size_t /*camera*/,
                                        const optics::Vec2& /*pixel*/) const override {
    return std::nullopt;
  }
  Result<> request(const AlignmentPicture& picture, OnPictures on_pictures,
                   IsWanted is_wanted) override {
    if (is_unplugged) return fail("there is no picture");
    EXPECT_TRUE(is_wanted());
    EXPECT_FALSE(picture.view) << "the whole picture";
    const std::lock_guard lock(mutex_);
    asked.push_back(picture.camera);
    sides.emplace_back(picture.width, picture.height);
    if (delivers_) {
      threads_.emplace_back([on_pictures] {
        on_pictures(AlignmentJpegs{hal::Clock::now(), {"a picture"}});
      });
    } else {
      waiting_.push_back(std::move(on_pictures));
    }
    return {};
  }
  void deliver(const Result<AlignmentJpegs>& made) {
    for (const OnPictures& on_pictures : std::exchange(waiting_, {})) on_pictures(made);
  }

  std::vector<std::size_t> asked;          ///< cameras in the order of their requests
  std::vector<std::pair<int, int>> sides;  ///< sides of their pictures
  std::vector<std::size_t> unwatched;
  bool is_unplugged = false;

 private:
  const bool delivers_;
  std::mutex mutex_;
  std::vector<OnPictures> waiting_;
  std::vector<std::jthread> threads_;
};

std::shared_ptr<const ViewProjection> room() {
  const auto model = optics::BallModel::make(optics::BallModel::Kind::Exact, 345).value();
  const auto ball = optics::BallProjection::make(model, {{310, 250}, 220, 200, 30}, {}).value();
  return std::make_shared<const ViewProjection>(
      ViewProjection::whole_picture(ball, 640, 480).value());
}

/// Two cameras, of which no view shows the ball.
WebContext two_cameras(Cameras& cameras) {
  WebContext context = make_context();
  context.alignment = &cameras;
  context.balls = {room(), room()};
  return context;
}

std::vector<std::string> names_of(const WebContext& context) {
  std::vector<std::string> names;
  for (const PictureSource& source : BallPictures(context).sources()) names.push_back(source.name);
  return names;
}

TEST(BallPictures, AreRequestedOnlyWhileTheyAreRead) {
  Cameras cameras;
  BallPictures balls(two_cameras(cameras));
  balls.follow();
  EXPECT_THAT(cameras.asked, ElementsAre()) << "there is no reader";
  const hal::TimePoint stamp = hal::Clock::now();
  {
    Feed::Reader reader(balls.all()[1].feeds.of(kFullSize), [] {});
    balls.follow();
    balls.follow();
    EXPECT_THAT(cameras.asked, ElementsAre(1U)) << "one at a time";
    cameras.deliver(AlignmentJpegs{stamp, {"a picture"}});
    const auto item = reader.next();
    ASSERT_TRUE(item);
    EXPECT_EQ(*item->bytes, "a picture");
    EXPECT_EQ(item->stamp, stamp);
    EXPECT_FALSE(item->aim) << "nobody can turn it";
    balls.follow();
    EXPECT_THAT(cameras.asked, ElementsAre(1U, 1U));
    cameras.deliver(AlignmentJpegs{stamp, {"the next picture"}});
  }
  balls.follow();
  EXPECT_THAT(cameras.asked, ElementsAre(1U, 1U)) << "the reader has gone";
}

TEST(BallPictures, AreMadeInEachSizeThatIsRead) {
  Cameras cameras;
  BallPictures balls(two_cameras(cameras));
  const PictureFeeds& feeds = balls.all()[0].feeds;
  Feed::Reader full(feeds.of(kFullSize), [] {}), quarter(feeds.of(3), [] {});
  balls.follow();
  EXPECT_THAT(cameras.sides, ElementsAre(std::pair(640, 480), std::pair(160, 120)));
  cameras.deliver(AlignmentJpegs{hal::Clock::now(), {"a picture"}});
  const auto large = full.next(), small = quarter.next();
  ASSERT_TRUE(large && small);
  EXPECT_EQ(small->width, 640) << "coordinates are those of the full picture";
  EXPECT_EQ(small->height, 480);
  EXPECT_NE(large->number, small->number) << "another picture";
}

TEST(BallPictures, ContinueAfterAFaultAndAFailure) {
  Cameras cameras;
  BallPictures balls(two_cameras(cameras));
  Feed::Reader reader(balls.all()[0].feeds.of(kFullSize), [] {});
  cameras.is_unplugged = true;
  balls.follow();
  EXPECT_THAT(cameras.asked, ElementsAre());
  cameras.is_unplugged = false;
  balls.follow();
  EXPECT_THAT(cameras.asked, ElementsAre(0U));
  cameras.deliver(fail("out of memory"));
  EXPECT_FALSE(reader.next());
  balls.follow();
  EXPECT_THAT(cameras.asked, ElementsAre(0U, 0U));
}

TEST(BallPictures, AreThoseThatNoViewShowsOfCamerasThatCanBeLookedAroundIn) {
  Cameras cameras;
  WebContext context = two_cameras(cameras);
  EXPECT_THAT(names_of(context), ElementsAre("ball:colour", "ball:thermal"));
  context.views[0].is_own_picture = true;
  context.views[0].sources.push_back({"thermal", "grey", {}, false});
  EXPECT_THAT(names_of(context), ElementsAre("ball:colour"));
  cameras.unwatched = {0};
  EXPECT_THAT(names_of(context), ElementsAre());
  context = two_cameras(cameras);
  context.balls[1] = nullptr;
  EXPECT_THAT(names_of(context), ElementsAre());
  context.alignment = nullptr;
  EXPECT_THAT(names_of(context), ElementsAre());
}

class ServedBalls : public Served {
 protected:
  void SetUp() override {
    sink = std::make_unique<WebSink>(on_a_free_port(), two_cameras(cameras));
    const auto started = sink->start();
    ASSERT_TRUE(started) << started.error().message;
  }
  void TearDown() override { sink.reset(); }

  Cameras cameras{true};
};

TEST_F(ServedBalls, AreLookedAroundInLikeViewsOfKindBall) {
  const json list = json::parse(get(port(), "/api/v1/look-around").body);
  EXPECT_EQ(list["spheres"], json::array({"ball:colour", "ball:thermal"}));
  const Answer mesh = get(port(), "/api/v1/sphere?view=ball:thermal");
  ASSERT_EQ(mesh.status, 200);
  const json head = json::parse(mesh.body.substr(0, mesh.body.find('\n')));
  EXPECT_EQ(head["width"], 640);
  EXPECT_EQ(head["height"], 480);
  EXPECT_NEAR(head["centre"][0].get<double>(), 310, 30) << "in the camera's own pixels";
  const Answer picture = get(port(), "/snapshot.jpg?view=ball:thermal");
  EXPECT_EQ(picture.status, 200);
  EXPECT_EQ(picture.body, "a picture");
  EXPECT_EQ(get(port(), "/snapshot.jpg?view=ball:other").status, 404);
}

TEST_F(ServedBalls, ComeWithTheLiveStream) {
  Client client(port());
  client.send(request_text("GET", "/api/v1/live?view=ball:colour", ""));
  for (int i = 0; i < 2; ++i) {
    EXPECT_THAT(client.take_until("a picture"), testing::HasSubstr("\"name\":\"ball:colour\""));
  }
}

}  // namespace
}  // namespace orbwatch::app::web::tests
