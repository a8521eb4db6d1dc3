// Repeats a test on every SIMD target that this machine has.
#pragma once

#include <gtest/gtest.h>
#include <hwy/targets.h>

namespace quell::test {

// Calls `check` with dispatch pinned to each target in turn, worst first. Plugins follow: they share Highway's state.
template <class Check>
void for_each_target(Check&& check) {
  const struct Restore {
    ~Restore() { hwy::SetSupportedTargetsForTest(0); }
  } restore;
  const auto present = hwy::SupportedTargets();
  for (const std::int64_t target : {HWY_SCALAR, HWY_SSE4, HWY_AVX2, HWY_AVX3}) {
    if (target != HWY_SCALAR && !(present & target)) continue;
    SCOPED_TRACE(hwy::TargetName(target));
    hwy::SetSupportedTargetsForTest(target);
    check();
  }
}

}  // namespace quell::test
