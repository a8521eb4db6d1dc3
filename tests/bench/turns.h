// Opponents taking turns in one process, each with the least wall and CPU time of its rounds.
//
// Drift of the clock rate and other work on the machine then meet all of them alike, which two runs of two programs
// cannot promise: it is the ratios of one table that count.
#pragma once

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <functional>
#include <string>
#include <thread>
#include <vector>

#include <xmmintrin.h>

namespace quell::bench {

inline double seconds(clockid_t clock) {
  timespec t;
  clock_gettime(clock, &t);
  return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
}

// CPU time of the process.
template <class Action>
double cpu_seconds_of(Action action) {
  const double begin = seconds(CLOCK_PROCESS_CPUTIME_ID);
  action();
  return seconds(CLOCK_PROCESS_CPUTIME_ID) - begin;
}

inline double median(std::vector<double> values) {
  std::ranges::sort(values);
  return values[values.size() / 2];
}

struct Cost {
  double wall = 1e9, cpu = 1e9;  // seconds; CPU of the whole process
};

struct Contestant {
  std::string name;
  std::function<void()> run;
  std::function<void()> prepare = [] {};  // before each run, no part of what is timed
};

// A round that does not count, for pages and caches, then `rounds` that do.
inline std::vector<Cost> take_turns(int rounds, const std::vector<Contestant>& contestants) {
  std::vector<Cost> least(contestants.size());
  for (int round = -1; round < rounds; ++round)
    for (std::size_t i = 0; i < contestants.size(); ++i) {
      contestants[i].prepare();
      const double wall = seconds(CLOCK_MONOTONIC), cpu = seconds(CLOCK_PROCESS_CPUTIME_ID);
      contestants[i].run();
      const Cost cost{seconds(CLOCK_MONOTONIC) - wall, seconds(CLOCK_PROCESS_CPUTIME_ID) - cpu};
      if (round >= 0) least[i] = {std::min(least[i].wall, cost.wall), std::min(least[i].cpu, cost.cpu)};
    }
  return least;
}

inline void print(const char* name, const Cost& cost) {
  std::printf("  %-44s %9.2f ms wall %9.2f ms cpu\n", name, 1e3 * cost.wall, 1e3 * cost.cpu);
}

// One table; the first is what the others are measured by.
inline std::vector<Cost> contest(int rounds, const std::vector<Contestant>& contestants) {
  const auto costs = take_turns(rounds, contestants);
  for (std::size_t i = 0; i < costs.size(); ++i) {
    print(contestants[i].name.c_str(), costs[i]);
    if (i > 0)
      std::printf("    %.3f times the first in wall time, %.3f in CPU time\n", costs[i].wall / costs[0].wall,
                  costs[i].cpu / costs[0].cpu);
  }
  return costs;
}

inline void flush_denormals() { _mm_setcsr(_mm_getcsr() | 0x8040u); }

// Calls work(y0, y1) for as many equal shares of the rows as there are threads, with denormals flushed as on the host's
// threads.
template <class Work>
void in_bands(int threads, int height, Work work) {
  std::vector<std::thread> others;
  for (int t = 1; t < threads; ++t)
    others.emplace_back([&, t] {
      flush_denormals();
      work(height * t / threads, height * (t + 1) / threads);
    });
  const unsigned before = _mm_getcsr();
  flush_denormals();
  work(0, height / threads);
  _mm_setcsr(before);
  for (auto& thread : others) thread.join();
}

}  // namespace quell::bench
