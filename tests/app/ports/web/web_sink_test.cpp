// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/web_sink.h"

#include <arpa/inet.h>
#include <gmock/gmock.h>
#include <sys/socket.h>

#include <atomic>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <regex>
#include <set>
#include <thread>

#include "app/model/status/json.h"
#include "app/model/status/readings.h"
#include "hal/thread/file_descriptor.h"
#include "tests/app/ports/web/served.h"

namespace orbwatch::app::web::tests {
namespace {

using nlohmann::json;
using testing::HasSubstr;

cv::Mat decoded(const std::string& jpeg) {
  return cv::imdecode(std::vector<std::uint8_t>(jpeg.begin(), jpeg.end()), cv::IMREAD_COLOR);
}

/// Mean difference in grey levels of a JPEG from the view that it shows.
double difference(const std::string& jpeg, const View& view) {
  const cv::Mat got = decoded(jpeg);
  const Picture& picture = view.picture;
  if (got.cols != picture.width || got.rows != picture.height) return 255;
  double sum = 0;
  for (int y = 0; y < got.rows; ++y) {
    const auto* row = reinterpret_cast<const std::uint8_t*>(picture.planes[0].data) +
                      y * picture.planes[0].stride;
    for (int x = 0; x < got.cols; ++x) {
      const auto& bgr = got.at<cv::Vec3b>(y, x);
      for (int c = 0; c < 3; ++c) sum += std::abs(bgr[2 - c] - row[3 * x + c]);
    }
  }
  return sum / (3.0 * got.cols * got.rows);
}

/// A picture of one colour, which JPEG preserves.
std::shared_ptr<View> plain_view(std::uint8_t level, std::size_t index = 0) {
  auto view = make_view(index, "front", level, 64, 48);
  std::fill(view->bytes.begin(), view->bytes.end(), level);
  return view;
}

TEST_F(Served, StatusHasEveryFigureOfTheModel) {
  start();
  const Answer answer = get(port(), "/api/v1/status");
  ASSERT_EQ(answer.status, 200);
  const json all = json::parse(answer.body);
  const Status status = app::tests::make_status();
  const auto names = app::tests::make_names();
  const json expected = to_json(status_readings({status, names, hal::Clock::now(), {}}));
  for (const auto& [kind, value] : expected.items()) {
    ASSERT_TRUE(all.contains(kind)) << kind;
    EXPECT_EQ(all[kind].size(), value.size()) << kind;
  }
  EXPECT_EQ(all["system"]["heartbeat"], expected["system"]["heartbeat"]);
  EXPECT_EQ(all["cameras"][1]["frames"], expected["cameras"][1]["frames"]);
  EXPECT_EQ(all["cameras"][1]["name"], "thermal");
  EXPECT_GE(all["age"], 0.0);
  EXPECT_TRUE(all["stamp"].is_string());
  EXPECT_EQ(all["web"]["requests"], 1);
}

TEST_F(Served, StatusBeforeTheFirstIsValidJson) {
  sink = std::make_unique<WebSink>(on_a_free_port(), make_context());
  ASSERT_TRUE(sink->start());
  const json all = json::parse(get(port(), "/api/v1/status").body);
  EXPECT_TRUE(all["age"].is_null());
  EXPECT_TRUE(all["stamp"].is_null());
  EXPECT_EQ(get(port(), "/healthz").status, 503);
}

TEST_F(Served, HealthFollowsThePipeline) {
  WebSettings settings;
  settings.status_timeout = std::chrono::milliseconds(0);
  start(settings);
  EXPECT_EQ(get(port(), "/healthz").status, 503);
  sink->stop();
  start();
  const Answer answer = get(port(), "/healthz");
  EXPECT_EQ(answer.status, 200);
  EXPECT_FALSE(answer.body.empty());
}

TEST_F(Served, MetricsAreInPrometheusFormat) {
  program.versions = {{"orbwatchd", "1.2.3"}};
  metrics = [] {
    const FieldInfo written{kCount, "written", "Samples"};
    return std::vector<InterfaceMetric>{{{"dds_topic", "rt/a"}, written, 3},
                                        {{"dds_topic", "rt/b"}, written, 4}};
  };
  start();
  const Answer answer = get(port(), "/metrics");
  ASSERT_EQ(answer.status, 200);
  static const std::regex kSample(
      R"rx([a-z_][a-z0-9_]*(\{(name|version)="([^"\\]|\\.)*"\})? (Nan|[+-]Inf|-?[0-9.]+(e[+-]?[0-9]+)?))rx");
  std::istringstream lines(answer.body);
  std::set<std::string> seen;
  std::string metric;
  int samples = 0;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("# HELP ")) {
      metric = line.substr(7, line.find(' ', 7) - 7);
      EXPECT_TRUE(seen.insert(metric).second) << "twice: " << metric;
    } else if (!line.starts_with("# TYPE ")) {
      EXPECT_TRUE(std::regex_match(line, kSample)) << line;
      EXPECT_EQ(line.substr(0, line.find_first_of("{ ")), metric);
      ++samples;
    }
  }
  EXPECT_GT(samples, 100);
  EXPECT_THAT(answer.body, HasSubstr("orbwatch_camera_frames{name=\"thermal\"} 1000000000"));
  EXPECT_THAT(answer.body, HasSubstr("\norbwatch_web_requests 1\n"));
  EXPECT_THAT(answer.body, HasSubstr("\norbwatch_dds_topic_written{name=\"rt/a\"} 3\n"
                                     "orbwatch_dds_topic_written{name=\"rt/b\"} 4\n"));
  EXPECT_THAT(answer.body, HasSubstr("\norbwatch_build_info{version=\"1.2.3\"} 1\n"));
}

TEST_F(Served, EveryAnswerHasTheStrictHeaders) {
  start();
  for (const char* target : {"/healthz", "/api/v1/status", "/nothing", "/snapshot.jpg"}) {
    const Answer answer = get(port(), target);
    EXPECT_THAT(answer.headers.at("Content-Security-Policy"), HasSubstr("default-src 'none'"));
    EXPECT_THAT(answer.headers.at("Content-Security-Policy"), HasSubstr("frame-ancestors 'none'"));
    EXPECT_EQ(answer.headers.at("Content-Security-Policy").find("unsafe"), std::string::npos);
    EXPECT_EQ(answer.headers.at("X-Content-Type-Options"), "nosniff");
    EXPECT_EQ(answer.headers.at("Cache-Control"), "no-store");
    EXPECT_FALSE(answer.headers.contains("Access-Control-Allow-Origin"));
  }
}

TEST_F(Served, RefusesWhatIsNotThere) {
  start();
  EXPECT_EQ(get(port(), "/nothing").status, 404);
  const Answer posted = request(port(), "POST", "/healthz", "", "x");
  EXPECT_EQ(posted.status, 405);
  EXPECT_EQ(posted.headers.at("Allow"), "GET");
  EXPECT_EQ(request(port(), "HEAD", "/nothing").status, 404);
  const Answer unnamed = get(port(), "/snapshot.jpg");
  EXPECT_EQ(unnamed.status, 400);
  EXPECT_THAT(unnamed.body, HasSubstr("view is missing; it must be a string"));
  const Answer unknown = get(port(), "/stream.mjpg?view=none");
  EXPECT_EQ(unknown.status, 404);
  EXPECT_THAT(unknown.body, HasSubstr("unknown view none; there are: front, wide"));
}

TEST_F(Served, RefusesForeignHostNames) {
  WebSettings settings;
  settings.names = {"ball.example"};
  start(settings);
  const auto status_for = [this](const std::string& host) {
    Client client(port());
    client.send("GET /healthz HTTP/1.1\r\nHost: " + host + "\r\n\r\n");
    return client.answer().status;
  };
  EXPECT_EQ(status_for("ball.example"), 200);
  EXPECT_EQ(status_for("evil.example"), 421);
  EXPECT_EQ(sink->statistics().refused, 1U);
}

TEST_F(Served, AViewThatNobodyReadsIsNotAskedFor) {
  start();
  EXPECT_FALSE(sink->needs(0, hal::Clock::now()).jpeg);
  hand_over(*sink, make_view(0, "front", 1, 64, 48));
  EXPECT_FALSE(sink->needs(7, hal::Clock::now()).jpeg);
}

TEST_F(Served, SnapshotIsTheNextPictureOfItsView) {
  start();
  const auto view = plain_view(90);
  std::thread pipeline([&] {
    EXPECT_TRUE(eventually([&] { return sink->needs(0, view->stamp).jpeg; }));
    EXPECT_FALSE(sink->needs(1, view->stamp).jpeg);
    sink->accept(view);
  });
  const Answer answer = get(port(), "/snapshot.jpg?view=front");
  pipeline.join();
  ASSERT_EQ(answer.status, 200);
  EXPECT_EQ(answer.headers.at("Content-Type"), "image/jpeg");
  EXPECT_LT(difference(answer.body, *view), 2);
  EXPECT_FALSE(sink->needs(0, hal::Clock::now()).jpeg) << "still asked for";
}

TEST_F(Served, SnapshotWithoutPictureEndsWithItsDeadline) {
  WebSettings settings;
  settings.request_timeout = std::chrono::milliseconds(300);
  start(settings);
  EXPECT_EQ(get(port(), "/snapshot.jpg?view=front").status, 503);
}

TEST_F(Served, StreamSendsEachPictureAtOnce) {
  start();
  Client client(port());
  client.send(request_text("GET", "/stream.mjpg?view=front"));
  const std::string head = client.take_until("\r\n\r\n");
  EXPECT_TRUE(head.starts_with("HTTP/1.1 200")) << head;
  EXPECT_THAT(head, HasSubstr("multipart/x-mixed-replace; boundary=orbwatch"));
  for (const std::uint8_t level : {40, 120, 200}) {
    const auto view = plain_view(level);
    ASSERT_TRUE(eventually([&] { return sink->needs(0, view->stamp).jpeg; }));
    sink->accept(view);
    if (level == 40) {
      EXPECT_EQ(client.take_until("--orbwatch\r\n"), "\r\n--orbwatch\r\n");
    }
    const std::string part = client.take_until("\r\n\r\n");
    static const std::regex kLength(R"(Content-Length: (\d+))");
    std::smatch length;
    ASSERT_TRUE(std::regex_search(part, length, kLength)) << part;
    EXPECT_LT(difference(client.take(std::stoul(length[1])), *view), 2) << int{level};
    EXPECT_EQ(client.take_until("--orbwatch\r\n"), "\r\n--orbwatch\r\n");
  }
  EXPECT_EQ(sink->statistics().pictures_sent, 3U);
  EXPECT_EQ(sink->statistics().streams, 1U);
}

TEST_F(Served, AStreamThatIsClosedIsNotEncodedFor) {
  start();
  {
    Client client(port());
    client.send(request_text("GET", "/stream.mjpg?view=front"));
    client.take_until("\r\n\r\n");
    EXPECT_TRUE(sink->needs(0, hal::Clock::now()).jpeg);
  }
  // Holds although no further picture arrives.
  EXPECT_TRUE(eventually([&] { return !sink->needs(0, hal::Clock::now()).jpeg; }));
  EXPECT_TRUE(eventually([&] { return sink->statistics().connections == 0; }));
  EXPECT_EQ(sink->statistics().streams, 0U);
}

/// They are closed although no other event wakes the threads of the library.
TEST_F(Served, StreamsWhoseReadersHaveGoneAreClosedBesideQuietConnections) {
  WebSettings settings;
  settings.request_timeout = std::chrono::minutes(1);
  settings.max_connections_per_address = 40;
  start(settings);
  constexpr std::size_t kEach = 16;
  std::vector<std::unique_ptr<Client>> quiet, readers;
  for (std::size_t i = 0; i < kEach; ++i) {
    quiet.push_back(std::make_unique<Client>(port()));
    readers.push_back(std::make_unique<Client>(port()));
    readers.back()->send(request_text("GET", "/stream.mjpg?view=front"));
    readers.back()->take_until("\r\n\r\n");
  }
  readers.clear();
  EXPECT_TRUE(eventually([&] { return sink->statistics().connections == kEach; }));
  EXPECT_EQ(sink->statistics().streams, 0U);
}

TEST_F(Served, StopEndsStreamsAndWaitingRequests) {
  start();
  Client stream(port());
  stream.send(request_text("GET", "/stream.mjpg?view=front"));
  stream.take_until("\r\n\r\n");
  Client waiting(port());
  waiting.send(request_text("GET", "/snapshot.jpg?view=wide"));
  ASSERT_TRUE(eventually([&] { return sink->needs(1, hal::Clock::now()).jpeg; }));
  sink->stop();
  EXPECT_EQ(stream.rest(), "");
  waiting.rest();
  EXPECT_EQ(sink->statistics().connections, 0U);
  hand_over(*sink, make_view(0, "front", 1, 64, 48));
}

/// Connects to a port of this computer, whether anybody listens or not, and disconnects.
void knock(int port) {
  const hal::FileDescriptor socket(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0));
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  ::connect(socket.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address);
}

/// The library's own way to stop listening first ends the process at random.
TEST_F(Served, StopsAgainAndAgainWhileClientsConnect) {
  constexpr int kRounds = 100;
  for (int round = 0; round < kRounds; ++round) {
    start();
    std::atomic<int> knocks{0};
    const auto connect = [&knocks, port = port()](const std::stop_token& end) {
      for (; !end.stop_requested(); ++knocks) knock(port);
    };
    const std::jthread one(connect), other(connect);
    ASSERT_TRUE(eventually([&] { return knocks > 2; })) << round;
    sink->stop();
  }
}

TEST_F(Served, APortThatIsTakenIsAnErrorThatNamesIt) {
  start();
  WebSettings taken = on_a_free_port();
  taken.port = port();
  WebSink other(taken, make_context());
  const auto started = other.start();
  ASSERT_FALSE(started);
  EXPECT_THAT(started.error().message, HasSubstr("127.0.0.1 port " + std::to_string(port())));
}

}  // namespace
}  // namespace orbwatch::app::web::tests
