// SPDX-License-Identifier: Apache-2.0
#include "base/process.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <memory>
#include <string>
#include <thread>

namespace throng {
namespace {

ProgramRun shell(const std::string& script) {
    return runProgram({"sh", "-c", script});
}

bool hasChildren() {
    return ::waitpid(-1, nullptr, WNOHANG) == 0 || errno != ECHILD;
}

/// Reads to the end of the output. @returns false where it has not come after ten seconds
bool readToTheEnd(Process& process) {
    pollfd source{process.output(), POLLIN, 0};
    while (::poll(&source, 1, 10'000) > 0)
        if (!process.read()) return true;
    return false;
}

TEST(Process, TellsTheExitCode) {
    EXPECT_TRUE(shell("exit 0").end.isGood());
    const ProgramEnd end = shell("exit 3").end;
    EXPECT_EQ(end.code, 3);
    EXPECT_EQ(end.signal, 0);
    EXPECT_FALSE(end.isGood());
    EXPECT_EQ(end.text(), "ended with code 3");
}

TEST(Process, TellsTheSignalThatKilled) {
    const ProgramEnd end = shell("kill -TERM $$").end;
    EXPECT_EQ(end.signal, SIGTERM);
    EXPECT_FALSE(end.isGood());
    EXPECT_EQ(end.text(), "was killed by signal 15 (Terminated)");
}

TEST(Process, TakesWordsAsTheyAre) {
    const std::string word = "$HOME; echo 'a b' \"c\" * \\ \n";
    EXPECT_EQ(runProgram({"printf", "%s", word}).output, word);
}

TEST(Process, KeepsOutputAndErrorsApartHoweverMuchTheyAre) {
    // Far more than a pipe holds, so that whoever reads one after the other waits for ever.
    const ProgramRun run = shell("head -c 3000000 /dev/zero >&2; head -c 2000000 /dev/zero; echo end");
    EXPECT_EQ(run.output, std::string(2'000'000, '\0') + "end\n");
    EXPECT_EQ(run.errors.size(), 3'000'000u);
}

TEST(Process, AMissingProgramIsNamed) {
    try {
        runProgram({"no-such-program", "word"});
        FAIL() << "it was started";
    } catch (const std::system_error& error) {
        EXPECT_STREQ(error.what(), "cannot start no-such-program: No such file or directory");
        EXPECT_EQ(error.code(), std::errc::no_such_file_or_directory);
    }
    EXPECT_THROW(runProgram({"/etc/passwd"}), std::system_error);
    EXPECT_FALSE(hasChildren());
}

TEST(Process, TalksThroughPipes) {
    Process process({"cat"}, {.input = StandardStream::pipe, .output = StandardStream::pipe});
    EXPECT_FALSE(process.write("one\n"));
    EXPECT_EQ(process.read(), "one\n");
    EXPECT_FALSE(process.write("two\n"));
    EXPECT_EQ(process.read(), "two\n");
    process.closeInput();
    EXPECT_EQ(process.read(), std::nullopt);
    EXPECT_TRUE(process.wait().isGood());
    EXPECT_TRUE(process.wait().isGood());
}

TEST(Process, WritesMoreThanAPipeHolds) {
    const std::string text(3'000'000, 'x');
    Process process({"wc", "-c"}, {.input = StandardStream::pipe, .output = StandardStream::pipe});
    EXPECT_FALSE(process.write(text));
    process.closeInput();
    EXPECT_EQ(process.read(), "3000000\n");
}

TEST(Process, WritingWhereNobodyReadsIsAnErrorAndNoSignal) {
    Process process({"sh", "-c", "exec <&-; echo closed"},
                    {.input = StandardStream::pipe, .output = StandardStream::pipe});
    EXPECT_EQ(process.read(), "closed\n");
    EXPECT_EQ(process.write("word"), std::errc::broken_pipe);
    sigset_t pending;
    ::sigpending(&pending);
    EXPECT_FALSE(::sigismember(&pending, SIGPIPE));
}

TEST(Process, SetsVariablesBesideOurs) {
    ::setenv("THRONG_TEST_OURS", "ours", 1);
    ::setenv("THRONG_TEST_REPLACED", "old", 1);
    Process process({"sh", "-c", "echo $THRONG_TEST_OURS $THRONG_TEST_REPLACED $THRONG_TEST_NEW"},
                    {.output = StandardStream::pipe,
                     .environment = {{"THRONG_TEST_REPLACED", "replaced"}, {"THRONG_TEST_NEW", "new"}}});
    EXPECT_EQ(process.read(), "ours replaced new\n");
    EXPECT_STREQ(::getenv("THRONG_TEST_REPLACED"), "old");
}

TEST(Process, GivesNoFilesOfOurs) {
    const int file = ::open("/dev/null", O_RDONLY);  // without O_CLOEXEC
    ASSERT_EQ(::dup2(file, 60), 60);
    EXPECT_EQ(shell("[ -e /proc/self/fd/60 ]").end.code, 1);
    EXPECT_EQ(::fcntl(60, F_GETFD), 0) << "ours stays as it was";
    ::close(60);
    ::close(file);
}

TEST(Process, StartsWhereStandardStreamsAreClosed) {
    const Descriptor input(::dup(STDIN_FILENO));
    ::close(STDIN_FILENO);
    const ProgramRun run = shell("echo out; echo errors >&2");
    Process cat({"cat"}, {.input = StandardStream::pipe, .output = StandardStream::pipe});
    EXPECT_FALSE(cat.write("word"));
    EXPECT_EQ(cat.read(), "word");
    ::dup2(input.get(), STDIN_FILENO);
    EXPECT_EQ(run.output, "out\n");
    EXPECT_EQ(run.errors, "errors\n");
}

TEST(Process, SignalsReachItsGroup) {
    Process process({"sh", "-c", "sleep 1000 & echo ready; wait"}, {.output = StandardStream::pipe});
    EXPECT_EQ(process.read(), "ready\n");
    process.tell(SIGTERM);
    EXPECT_TRUE(readToTheEnd(process)) << "what it has started still holds the output";
    EXPECT_EQ(process.wait().signal, SIGTERM);
}

TEST(Process, NobodyIsLeftBehind) {
    Descriptor output;
    {
        Process process({"sh", "-c", "sleep 1000 & echo ready; wait"}, {.output = StandardStream::pipe});
        EXPECT_EQ(process.read(), "ready\n");
        output.reset(::dup(process.output()));
    }
    pollfd source{output.get(), POLLIN, 0};
    EXPECT_EQ(::poll(&source, 1, 10'000), 1) << "what it has started still runs";
    EXPECT_TRUE(source.revents & POLLHUP);
    EXPECT_FALSE(hasChildren());
}

TEST(Process, EndsWithWhoeverStartedItIfItShall) {
    const auto startedByAThreadThatEnds = [](bool ends_with_us) {
        std::unique_ptr<Process> process;
        std::thread([&] {
            process = std::make_unique<Process>(
                std::vector<std::string>{"sleep", "1000"},
                ProcessOptions{.output = StandardStream::pipe, .ends_with_us = ends_with_us});
        }).join();
        pollfd source{process->output(), POLLIN, 0};
        return ::poll(&source, 1, ends_with_us ? 10'000 : 200) == 0 ? 0 : process->wait().signal;
    };
    EXPECT_EQ(startedByAThreadThatEnds(true), SIGTERM);
    EXPECT_EQ(startedByAThreadThatEnds(false), 0);
}

}  // namespace
}  // namespace throng
