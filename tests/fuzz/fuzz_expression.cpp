// Any text is arithmetic over metrics, a condition on one, or is refused in words.
#include "core/lab/expression.h"
#include "core/lab/threshold.h"
#include "core/report/error.h"

#include <cmath>
#include <cstdint>
#include <cstdlib>

namespace {

template <class Use>
void use_or_refuse(Use use) {
  try {
    use();
  } catch (const quell::Error& e) {
    if (std::string_view(e.what()).empty() || e.exit() != quell::Exit::usage) std::abort();
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  use_or_refuse([&] {
    const quell::Expression expression(text);
    std::size_t asked = 0;
    const auto value = [&](const std::string& name) { return double(name.size() + asked++); };
    const double first = expression(value);
    asked = 0;
    const double again = expression(value);
    if (first != again && !(std::isnan(first) && std::isnan(again))) std::abort();
    if (asked < expression.names().size()) std::abort();
  });
  use_or_refuse([&] {
    const auto condition = quell::parse_threshold(text, "--fail");
    if (condition.metric.empty() || !std::isfinite(condition.limit)) std::abort();
    (void)condition.met_by(condition.of(quell::summarize(std::vector<double>{1, 2, 4})));
  });
  return 0;
}
