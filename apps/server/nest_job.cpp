#include "nest_job.hpp"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>
#include <utility>

#include "lekalo/base/joined_text.hpp"
#include "lekalo/jobs/nest.hpp"

namespace lekalo::server {
namespace {

using layout::Document;

constexpr double kLeastSeconds = 0.1, kMostSeconds = 3600;
constexpr unsigned kThreads = 2;

std::vector<std::string_view> words_of(std::string_view line) {
  std::vector<std::string_view> words;
  for (std::size_t at = 0; at < line.size();) {
    const std::size_t begin = line.find_first_not_of(' ', at);
    if (begin == std::string_view::npos) break;
    at = std::min(line.find(' ', begin), line.size());
    words.push_back(line.substr(begin, at - begin));
  }
  return words;
}

template <class Number>
bool read(std::string_view word, Number& number) {
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  return error == std::errc() && end == word.data() + word.size();
}

Result<NestRequest> read_request(const std::vector<std::string_view>& words, const Document& document) {
  NestRequest request;
  const auto bad = [](const std::string& why) { return failure(ErrorCode::bad_input, "nest: " + why); };
  std::size_t at = 1;
  if (at < words.size() && words[at] != "for") {
    std::string_view rest = words[at++];
    while (true) {
      const std::size_t comma = rest.find(',');
      std::uint64_t id = 0;
      if (!read(rest.substr(0, comma), id))
        return bad(fmt::format("'{}' is not the number of a placement", rest.substr(0, comma)));
      request.ids.push_back(id);
      if (comma == std::string_view::npos) break;
      rest.remove_prefix(comma + 1);
    }
    std::sort(request.ids.begin(), request.ids.end());
    request.ids.erase(std::unique(request.ids.begin(), request.ids.end()), request.ids.end());
  }
  if (at + 1 >= words.size() || words[at] != "for" || !read(words[at + 1], request.seconds) ||
      !(request.seconds >= kLeastSeconds && request.seconds <= kMostSeconds))
    return bad("it needs a time, 'for SECONDS', from 0.1 to 3600");
  at += 2;
  if (at < words.size()) {
    if (words.size() != at + 2 || words[at] != "seed" || !read(words[at + 1], request.seed))
      return bad(
          fmt::format("'{}' is one word too many; after the time only 'seed NUMBER' may stand", words[at]));
  }
  LEKALO_CHECK(jobs::fine_selection(document, request.ids));
  return request;
}

/// Sets a flag when the time is up or another flag is set.
class Deadline {
 public:
  Deadline(double seconds, const RunControl& run)
      : end_(std::chrono::steady_clock::now() +
             std::chrono::duration_cast<std::chrono::steady_clock::duration>(
                 std::chrono::duration<double>(seconds))),
        thread_([this, &run] { watch(run); }) {}
  ~Deadline() {
    {
      const std::lock_guard lock(mutex_);
      over_ = true;
    }
    changed_.notify_one();
    thread_.join();
  }
  Deadline(const Deadline&) = delete;
  Deadline& operator=(const Deadline&) = delete;
  const std::atomic<bool>* flag() const noexcept { return &flag_; }

 private:
  void watch(const RunControl& run) {
    std::unique_lock lock(mutex_);
    while (!over_ && !flag_) {
      if (run.stop_requested() || std::chrono::steady_clock::now() >= end_) flag_ = true;
      changed_.wait_for(lock, std::chrono::milliseconds(50));
    }
  }
  std::chrono::steady_clock::time_point end_;
  std::atomic<bool> flag_{false};
  std::mutex mutex_;
  std::condition_variable changed_;
  bool over_ = false;
  std::thread thread_;  // stands last, because it uses the others
};

Result<layout::Change> run(const Document& document, const NestRequest& request, const JobContext& context) {
  const auto begin = std::chrono::steady_clock::now();
  const Deadline deadline(request.seconds, context.run);
  jobs::NestOptions options;
  options.seed = request.seed;
  options.threads = kThreads;
  options.only = request.ids;
  if (context.improved)
    options.improved = [&](const Document& better, std::string_view) -> Result<void> {
      context.improved(layout::difference(document, better));
      return {};
    };
  RunControl control;
  control.stop = deadline.flag();
  control.progress = [&](const Progress& progress) {
    const double passed = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    if (context.run.progress) context.run.progress({progress.work, std::min(1.0, passed / request.seconds)});
  };
  LEKALO_TRY(const jobs::Nested nested, jobs::nest(document, options, control));
  return layout::difference(document, nested.document);
}

}  // namespace

std::optional<Result<NestRequest>> nest_request(std::string_view line, const Document& document) {
  const std::vector<std::string_view> words = words_of(line);
  if (words.empty() || words[0] != "nest") return std::nullopt;
  return read_request(words, document);
}

std::string to_text(const NestRequest& request) {
  std::string text = "nest ";
  if (!request.ids.empty()) text += joined_text(request.ids, ",") + " ";
  text += fmt::format("for {}", request.seconds);
  if (request.seed != 0) text += fmt::format(" seed {}", request.seed);
  return text;
}

Job job_of(const NestRequest& request) {
  return [request](const Document& document, const JobContext& context) {
    return run(document, request, context);
  };
}

}  // namespace lekalo::server
