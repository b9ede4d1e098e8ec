#include "proc/remap/kernel.h"

#include <algorithm>
#include <cstdlib>
#include <string>

#include "proc/remap/remap_scalar.h"
#if defined(__x86_64__)
#include "proc/remap/remap_avx2.h"
#include "proc/remap/remap_avx512.h"
#elif defined(__aarch64__)
#include "proc/remap/remap_neon.h"
#endif

namespace orbwatch::remap {
namespace {

/// One of the kernels that there are, on whatever machine.
struct Candidate {
  std::string_view name;
  const Kernel* kernel;  ///< null where this machine cannot run it
};

/// All kernels, the fastest one of each kind of machine last.
std::array<Candidate, 4> candidates() {
  const Kernel* neon = nullptr;
  const Kernel* avx2 = nullptr;
  const Kernel* avx512 = nullptr;
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx2")) avx2 = &kAvx2Kernel;
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
      __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512vbmi")) {
    avx512 = &kAvx512Kernel;
  }
#elif defined(__aarch64__)
  neon = &kNeonKernel;  // part of the architecture
#endif
  return {{{"scalar", &kScalarKernel}, {"neon", neon}, {"avx2", avx2}, {"avx512", avx512}}};
}

/// Those that this machine runs.
class Runnable {
 public:
  Runnable() {
    for (const Candidate& candidate : candidates()) {
      if (candidate.kernel) kernels_[count_++] = candidate.kernel;
    }
  }
  std::span<const Kernel* const> kernels() const { return {kernels_.data(), count_}; }

 private:
  std::array<const Kernel*, 4> kernels_{};
  std::size_t count_ = 0;
};

/// The names of what satisfies `good`, as in "scalar, avx2".
template <class Good>
std::string names(const Good& good) {
  std::string list;
  for (const Candidate& candidate : candidates()) {
    if (!good(candidate)) continue;
    if (!list.empty()) list += ", ";
    list += candidate.name;
  }
  return list;
}

}  // namespace

std::span<const Kernel* const> kernels() {
  static const Runnable kRunnable;
  return kRunnable.kernels();
}

Result<const Kernel*> find_kernel(std::string_view name) {
  const auto all = candidates();
  const auto* const found =
      std::find_if(all.begin(), all.end(), [&](const Candidate& c) { return c.name == name; });
  if (found == all.end()) {
    return fail("remap kernel '" + std::string(name) + "' is none of " +
                names([](const Candidate&) { return true; }));
  }
  if (!found->kernel) {
    return fail("this machine cannot run the remap kernel '" + std::string(name) + "', only " +
                names([](const Candidate& c) { return c.kernel != nullptr; }));
  }
  return found->kernel;
}

Result<const Kernel*> requested_kernel() {
  const char* const name = std::getenv("ORBWATCH_ISA");
  if (!name) return kernels().back();
  const auto found = find_kernel(name);
  return found ? found : fail("ORBWATCH_ISA: " + found.error().message);
}

const Kernel& default_kernel() {
  static const Kernel& kChosen = *requested_kernel().value_or(kernels().back());
  return kChosen;
}

}  // namespace orbwatch::remap
