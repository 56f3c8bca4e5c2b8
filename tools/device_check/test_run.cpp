#include "tools/device_check/test_run.h"

#include <algorithm>
#include <charconv>
#include <map>
#include <thread>

namespace device_check {
namespace {

constexpr size_t kTextBytes = 3000;

// "Suite." lines and indented names, each with a comment behind # if it has parameters.
std::vector<std::string> namesIn(const std::vector<std::string>& lines) {
    std::vector<std::string> names;
    std::string suite;
    for (const std::string& line : lines) {
        const std::string word = line.substr(0, line.find('#'));
        const size_t end = word.find_last_not_of(' ');
        if (end == std::string::npos) continue;
        if (word[0] != ' ')
            suite = word.substr(0, end + 1);
        else if (suite.ends_with('.'))
            names.push_back(suite + word.substr(2, end - 1));
    }
    return names;
}

struct StatusLine {
    const char* begins;
    TestEnd end;
};
constexpr StatusLine kStatusLines[] = {
    {"[       OK ] ", TestEnd::Passed}, {"[  SKIPPED ] ", TestEnd::Skipped}, {"[  FAILED  ] ", TestEnd::Failed}};
constexpr std::string_view kRuns = "[ RUN      ] ";

double msIn(std::string_view line) {
    const size_t open = line.rfind('(');
    double ms = 0;
    if (open != std::string_view::npos) std::from_chars(line.data() + open + 1, line.data() + line.size(), ms);
    return ms;
}

// Follows what one process prints.
class Listener {
public:
    explicit Listener(std::map<std::string, TestOutcome*>& tests) : tests_(tests) {}

    void hear(std::string_view line) {
        if (line.starts_with(kRuns)) {
            const auto found = tests_.find(std::string(line.substr(kRuns.size())));
            running_ = found == tests_.end() ? nullptr : found->second;
            since_ = Clock::now();
            return;
        }
        if (running_ == nullptr) return;
        for (const StatusLine& status : kStatusLines)
            if (line.starts_with(status.begins)) return end(status.end, line);
        if (running_->text.size() < kTextBytes) running_->text += std::string(line) + "\n";
    }
    TestOutcome* running() const { return running_; }
    std::chrono::duration<double> runningFor() const { return Clock::now() - since_; }
    bool hasFailures() const { return has_failures_; }

private:
    void end(TestEnd how, std::string_view line) {
        has_failures_ = has_failures_ || how == TestEnd::Failed;
        running_->end = how;
        running_->ms = msIn(line);
        if (how == TestEnd::Passed) running_->text.clear();
        running_ = nullptr;
    }

    std::map<std::string, TestOutcome*>& tests_;
    TestOutcome* running_ = nullptr;
    Clock::time_point since_;
    bool has_failures_ = false;
};

std::string filterOf(const std::vector<TestOutcome*>& tests) {
    std::string filter = "--gtest_filter=";
    for (const TestOutcome* test : tests)
        filter += test->name + ":";
    return filter;
}

constexpr double kLongForATest = 0.3; // of the patience

// The test that was running when its process ended. Out of time is no fault of a test that has just begun.
void blame(const Listener& listener, const TestRunOptions& options, const ChildEnd& end) {
    TestOutcome& test = *listener.running();
    const bool is_late = end.kind == ChildEnd::Kind::OutOfTime, has_patience = options.patience.count() > 0;
    if (is_late && !(has_patience && listener.runningFor() > kLongForATest * options.patience)) return;
    test.end = is_late || end.kind == ChildEnd::Kind::Silent ? TestEnd::Hung : TestEnd::Crashed;
    test.text += end.reason + "\n" + end.errors;
}

// Describes a bad end of a process whose tests have all ended. Tests that fail, and tests that all skip themselves, give exit
// codes.
std::string problemOf(const TestRunOptions& options, const Listener& listener, const ChildEnd& end) {
    constexpr int kAllSkipped = 77;
    if (listener.running() != nullptr || end.isGood() || end.kind == ChildEnd::Kind::OutOfTime) return "";
    if (end.kind == ChildEnd::Kind::Exited && (end.code == kAllSkipped || (end.code == 1 && listener.hasFailures()))) return "";
    return options.program + " ended badly behind its last test: " + end.reason;
}

// One process after another, until each of these tests has ended or the time has. Returns a problem, if there was one.
std::string runAll(const Kit& kit, const TestRunOptions& options, std::vector<TestOutcome*> tests) {
    std::string problem;
    std::map<std::string, TestOutcome*> by_name;
    for (TestOutcome* test : tests)
        by_name[test->name] = test;
    while (!tests.empty() && Clock::now() < options.until) {
        ChildCommand command = kit.command(options.program, {filterOf(tests), "--gtest_color=no"}, options.until);
        command.environment.insert(command.environment.end(), options.environment.begin(), options.environment.end());
        command.patience = options.patience;
        Listener listener(by_name);
        const ChildEnd end = runChild(command, [&](std::string_view line) { listener.hear(line); });
        if (listener.running() != nullptr) blame(listener, options, end);
        const size_t before = tests.size();
        std::erase_if(tests, [](const TestOutcome* test) { return test->end != TestEnd::NotRun; });
        if (tests.size() == before && end.kind != ChildEnd::Kind::OutOfTime) { // it does not even start
            tests.front()->end = TestEnd::Crashed;
            tests.front()->text = end.reason + "\n" + end.errors;
            return problem;
        }
        if (problem.empty()) problem = problemOf(options, listener, end);
    }
    return problem;
}

void listTests(const Kit& kit, const TestRunOptions& options, TestRun& run) {
    std::vector<std::string> lines;
    const ChildEnd listed =
        runChild(kit.command(options.program, {"--gtest_list_tests", "--gtest_filter=" + options.filter}, options.until),
                 [&](std::string_view line) { lines.emplace_back(line); });
    if (listed.kind == ChildEnd::Kind::OutOfTime) return; // a later run lists them
    if (!listed.isGood()) {
        run.problem = "the tests of " + options.program + " cannot be listed: " + listed.reason;
        return;
    }
    run.problem.clear();
    for (std::string& name : namesIn(lines))
        run.tests.push_back({.name = std::move(name)});
}

const char* nameOf(TestEnd end) {
    switch (end) {
    case TestEnd::Passed: return "passed";
    case TestEnd::Skipped: return "skipped";
    case TestEnd::Failed: return "failed";
    case TestEnd::Crashed: return "crashed";
    case TestEnd::Hung: return "hung";
    default: return "not run";
    }
}

} // namespace

size_t TestRun::count(TestEnd end) const { return static_cast<size_t>(std::ranges::count(tests, end, &TestOutcome::end)); }

bool TestRun::isComplete() const { return !tests.empty() && count(TestEnd::NotRun) == 0; }

bool TestRun::isSkipped() const { return !tests.empty() && count(TestEnd::Skipped) == tests.size(); }

bool TestRun::isGood() const {
    return problem.empty() && count(TestEnd::Failed) + count(TestEnd::Crashed) + count(TestEnd::Hung) == 0;
}

void runTests(const Kit& kit, const TestRunOptions& options, TestRun& run) {
    if (!kit.hasProgram(options.program)) {
        run.problem = "the tests of " + options.program + " cannot be listed: the program is missing";
        return;
    }
    if (run.tests.empty()) listTests(kit, options, run);
    std::vector<std::vector<TestOutcome*>> shares(std::max(1u, options.processes));
    size_t next = 0;
    for (TestOutcome& test : run.tests)
        if (test.end == TestEnd::NotRun) shares[next++ % shares.size()].push_back(&test);
    std::vector<std::string> problems(shares.size());
    {
        std::vector<std::jthread> threads;
        for (size_t k = 0; k < shares.size(); ++k)
            if (!shares[k].empty()) threads.emplace_back([&, k] { problems[k] = runAll(kit, options, shares[k]); });
    }
    for (const std::string& problem : problems)
        if (run.problem.empty()) run.problem = problem;
}

Json toJson(const TestRun& run) {
    Json json = {{"tests", run.tests.size()}};
    json["listed"] = !run.tests.empty();
    for (const TestEnd end :
         {TestEnd::Passed, TestEnd::Skipped, TestEnd::Failed, TestEnd::Crashed, TestEnd::Hung, TestEnd::NotRun})
        json[nameOf(end)] = run.count(end);
    if (!run.problem.empty()) json["problem"] = run.problem;
    json["findings"] = Json::array();
    for (const TestOutcome& test : run.tests)
        if (test.end == TestEnd::Failed || test.end == TestEnd::Crashed || test.end == TestEnd::Hung)
            json["findings"].push_back({{"test", test.name}, {"end", nameOf(test.end)}, {"text", test.text}});
    return json;
}

} // namespace device_check
