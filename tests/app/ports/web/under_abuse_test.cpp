// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "tests/app/ports/dds/fastdds/pace.h"
#include "tests/app/ports/web/abuses.h"
#include "tests/app/ports/web/served.h"
#include "tests/support/sanitizers.h"
#include "tests/support/temporary_folder.h"

namespace orbwatch::app::web::tests {
namespace {

/// Pictures made in advance, so that passing them does not wait for memory.
class SmallPictures final : public app::tests::Pace {
 public:
  explicit SmallPictures(WebSink& sink) : sink_(sink) {
    for (std::uint64_t n = 0; n < 30; ++n) {
      views_.push_back(make_view(0, "front", n, 320, 240));
    }
  }

 private:
  void hand_over_now(std::uint64_t number) override {
    app::tests::hand_over(sink_, views_[number % views_.size()]);
  }

  WebSink& sink_;
  std::vector<ViewPtr> views_;
};

class WebUnderAbuse : public Served, public testing::WithParamInterface<orbwatch::tests::Abuse> {
 protected:
  ~WebUnderAbuse() override { sink.reset(); }  // the sink writes to the folder until its end
  const orbwatch::tests::TemporaryFolder folder_;
};

TEST_P(WebUnderAbuse, OthersAreAnsweredAndThePipelineDoesNotWait) {
  WebSettings settings;
  // Longer than a busy machine needs for an answer, shorter than the rounds.
  settings.request_timeout = std::chrono::seconds(2);
  settings.max_connections = 400;
  settings.max_connections_per_address = 300;
  settings.max_streams = 200;
  settings.status_timeout = std::chrono::hours(1);  // this thread is the pipeline, and may be late
  state_folder = folder_.path();
  const std::string header = add_users(state_folder);
  start(settings);
  SmallPictures pictures(*sink);
  {
    orbwatch::tests::Abused abused(GetParam(), port());
    for (int round = 0; round < 25; ++round) {
      pictures.hand_over(3);
      EXPECT_EQ(get(port(), "/healthz").status, 200);
      EXPECT_EQ(get(port(), "/api/v1/status", header).status, 200);
      sink->accept(app::tests::make_status());
    }
    EXPECT_TRUE(eventually([&] { return abused.acts() > 10; }));
  }
  // Another thread may be preempted while it briefly holds a lock; under sanitizers threads also
  // contend for memory.
  if (!orbwatch::tests::kIsSanitized) {
    EXPECT_LE(pictures.waits(), pictures.accepted() / 20 + 2);
  }
  EXPECT_TRUE(eventually([&] { return sink->statistics().connections == 0; }));
}

INSTANTIATE_TEST_SUITE_P(, WebUnderAbuse, testing::ValuesIn(abuses()), [](const auto& abuse) {
  std::string name(abuse.param.name);
  std::erase(name, ' ');
  return name;
});

}  // namespace
}  // namespace orbwatch::app::web::tests
