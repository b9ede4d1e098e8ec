// SPDX-License-Identifier: Apache-2.0
#include "tests/bench/counted_merge.h"

namespace {

using orbwatch::bench::MergedCase, orbwatch::bench::MergedView;

class OurMerge {
 public:
  static bool takes(const MergedCase&) { return true; }
  explicit OurMerge(MergedView& view) : view_(view) {}
  void run() { view_.run(); }

 private:
  MergedView& view_;
};

}  // namespace

int main(int argc, char** argv) { return orbwatch::bench::counted_merge<OurMerge>(argc, argv); }
