// Summaries over frames and seeds.
#include "core/lab/results.h"

namespace quell {

namespace {

class Summarizer {
 public:
  explicit Summarizer(const Results& results) : r_(results) {}

  std::vector<ResultSummary> run() {
    for (std::size_t s = 0; s < r_.sequences.size(); ++s) add(s, s, s + 1);
    if (r_.sequences.size() > 1) add(std::nullopt, 0, r_.sequences.size());
    return std::move(all_);
  }

 private:
  void add(std::optional<std::size_t> sequence, std::size_t first, std::size_t end) {
    for (std::size_t v = 0; v < r_.variants.size(); ++v)
      for (std::size_t m = 0; m < r_.metrics.size(); ++m) {
        std::vector<double> numbers, differences;
        for (std::size_t s = first; s < end; ++s) gather(s, v, m, numbers, differences);
        all_.push_back({v, sequence, m, summarize(numbers), summarize(differences)});
      }
  }

  void gather(std::size_t s, std::size_t v, std::size_t m, std::vector<double>& numbers,
              std::vector<double>& differences) const {
    for (std::size_t seed = 0; seed < r_.seed_count(); ++seed)
      for (auto f = std::size_t(r_.warm_up); f < r_.sequences[s].frames.size(); ++f) {
        const auto& number = r_.numbers[s][seed][v][f][m];
        const auto& base = r_.numbers[s][seed][0][f][m];
        if (number) numbers.push_back(*number);
        if (number && base) differences.push_back(*number - *base);
      }
  }

  const Results& r_;
  std::vector<ResultSummary> all_;
};

}  // namespace

std::vector<ResultSummary> summaries(const Results& results) { return Summarizer(results).run(); }

}  // namespace quell
