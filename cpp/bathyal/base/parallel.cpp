// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/base/parallel.hpp"

#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <exception>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "bathyal/base/error.hpp"

namespace bathyal {
namespace {

thread_local bool inside_body = false;

/// One call of parallel_for. Helpers and the caller draw chunk numbers from `next` until none is
/// left.
struct Job {
  std::size_t count;
  std::size_t grain;
  std::size_t chunks;
  const std::function<void(std::size_t, std::size_t)>* body;
  std::atomic<std::size_t> next{0};
  std::atomic<std::size_t> done{0};
  std::mutex mutex;
  std::condition_variable finished;
  std::size_t failed_chunk = static_cast<std::size_t>(-1);
  std::exception_ptr failure;

  void work() {
    const bool was_inside = inside_body;
    inside_body = true;
    for (std::size_t chunk = next++; chunk < chunks; chunk = next++) {
      try {
        (*body)(chunk * grain, std::min(count, (chunk + 1) * grain));
      } catch (...) {
        const std::lock_guard lock(mutex);
        if (chunk < failed_chunk) {
          failed_chunk = chunk;
          failure = std::current_exception();
        }
      }
      if (++done == chunks) {
        const std::lock_guard lock(mutex);
        finished.notify_all();
      }
    }
    inside_body = was_inside;
  }
};

/// Threads that wait for jobs; grown on demand to the number requested, never shrunk, and never
/// destroyed: they wait until the process ends. A job stays alive through its shared_ptr for as
/// long as a late helper looks at it.
class Pool {
 public:
  void help(const std::shared_ptr<Job>& job, std::size_t helpers) {
    {
      const std::lock_guard lock(mutex_);
      while (threads_.size() < helpers) threads_.emplace_back([this] { serve(); });
      for (std::size_t i = 0; i < helpers; ++i) queue_.push_back(job);
    }
    wake_.notify_all();
  }

 private:
  void serve() {
    std::unique_lock lock(mutex_);
    while (true) {
      wake_.wait(lock, [this] { return !queue_.empty(); });
      const std::shared_ptr<Job> job = std::move(queue_.back());
      queue_.pop_back();
      lock.unlock();
      job->work();
      lock.lock();
    }
  }

  std::mutex mutex_;
  std::condition_variable wake_;
  std::vector<std::shared_ptr<Job>> queue_;
  std::vector<std::thread> threads_;
};

/// The process's pool. A forked child has none of its parent's threads, so it starts a pool of its
/// own and leaves the parent's alone.
Pool& pool() {
  static std::mutex mutex;
  static Pool* current = nullptr;
  static pid_t owner = 0;
  const std::lock_guard lock(mutex);
  if (current == nullptr || owner != getpid()) {
    current = new Pool;
    owner = getpid();
  }
  return *current;
}

}  // namespace

int resolve_threads(int num_threads) {
  if (num_threads < 0) {
    throw_argument("num_threads", "0 (all) or more", std::to_string(num_threads));
  }
  if (num_threads > 0) return num_threads;
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

void parallel_for(std::size_t count, std::size_t grain, int num_threads,
                  const std::function<void(std::size_t, std::size_t)>& body) {
  const auto threads = static_cast<std::size_t>(resolve_threads(num_threads));
  if (count == 0) return;
  if (grain == 0) grain = 1;
  const auto job = std::make_shared<Job>();
  job->count = count;
  job->grain = grain;
  job->chunks = (count + grain - 1) / grain;
  job->body = &body;
  const std::size_t helpers = inside_body ? 0 : std::min(threads, job->chunks) - 1;
  if (helpers > 0) pool().help(job, helpers);
  job->work();
  if (helpers > 0) {
    std::unique_lock lock(job->mutex);
    job->finished.wait(lock, [&] { return job->done == job->chunks; });
  }
  if (job->failure) std::rethrow_exception(job->failure);
}

}  // namespace bathyal
