// SPDX-License-Identifier: Apache-2.0
#include "harness.h"

#include <fmt/format.h>
#include <sanitizer/common_interface_defs.h>
#include <sys/time.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <fstream>

#include "base/files/errors.h"

extern "C" {
std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t most);
// As in sanitizer/allocator_interface.h, which GCC does not bring along.
int __sanitizer_install_malloc_and_free_hooks(void (*allocated)(const volatile void*, std::size_t),
                                              void (*released)(const volatile void*));
std::size_t __sanitizer_get_allocated_size(const volatile void* place);
}

namespace throng::fuzz {
namespace {

constexpr std::int64_t kLeastBytes = std::int64_t{256} << 20, kBytesPerByte = 10;
constexpr int kMostSeconds = 10;
constexpr std::size_t kLongestMessage = 2000;

int own_errors = STDERR_FILENO;  // stays open where libFuzzer closes what readers print to
std::atomic<std::int64_t> most_bytes = INT64_MAX, held_bytes = 0;
std::filesystem::path own_folder;

void say(const char* text) {
    static_cast<void>(!::write(own_errors, text, std::strlen(text)));
}

void onAllocation(const volatile void*, std::size_t size) {
    if (held_bytes.fetch_add(static_cast<std::int64_t>(size)) + static_cast<std::int64_t>(size) <= most_bytes)
        return;
    most_bytes = INT64_MAX;  // what follows needs memory, too
    finding("more memory than ten times the file and 256 MiB");
}

void onRelease(const volatile void* place) {
    const void* const block = const_cast<const void*>(place);
    if (block) held_bytes -= static_cast<std::int64_t>(__sanitizer_get_allocated_size(block));
}

void onTimeOver(int) {
    say("\nfinding: more than 10 s of processor time\n");
    __sanitizer_print_stack_trace();
    std::abort();
}

/// Of the processor's time, whichever else is busy.
void setTimeLimit(int seconds) {
    const itimerval limit{{0, 0}, {seconds, 0}};
    ::setitimer(ITIMER_PROF, &limit, nullptr);
}

class Bounds {
  public:
    explicit Bounds(std::size_t size) {
        held_bytes = 0;
        most_bytes = kLeastBytes + kBytesPerByte * static_cast<std::int64_t>(size);
        setTimeLimit(kMostSeconds);
    }
    ~Bounds() {
        setTimeLimit(0);
        most_bytes = INT64_MAX;
    }
    Bounds(const Bounds&) = delete;
    Bounds& operator=(const Bounds&) = delete;
};

}  // namespace

const std::filesystem::path& folder() {
    return own_folder;
}

std::filesystem::path put(const std::string& name, std::string_view bytes) {
    const std::filesystem::path path = own_folder / name;
    std::filesystem::create_directories(path.parent_path());
    std::ofstream(path, std::ios::binary | std::ios::trunc)
        .write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    return path;
}

void finding(const std::string& what) {
    say(fmt::format("\nfinding: {}\n", what).c_str());
    __sanitizer_print_stack_trace();
    std::abort();
}

std::string mutatedBytes(std::string_view bytes, std::size_t most) {
    std::string result(bytes.substr(0, most));
    const std::size_t size = result.size();
    result.resize(std::max<std::size_t>(most, 1));
    result.resize(LLVMFuzzerMutate(reinterpret_cast<std::uint8_t*>(result.data()), size, result.size()));
    return result;
}

}  // namespace throng::fuzz

using namespace throng;

/// Fonts are found once in a process, and what that takes is never given back.
extern "C" const char* __lsan_default_suppressions() {
    return "leak:libfontconfig";
}

extern "C" int LLVMFuzzerInitialize(int*, char***) {
    fuzz::own_errors = ::dup(STDERR_FILENO);
    std::string name = (std::filesystem::temp_directory_path() / "throng-fuzz-XXXXXX").string();
    if (!::mkdtemp(name.data())) fuzz::finding("no temporary folder");
    fuzz::own_folder = name;
    std::atexit([] {
        std::error_code ignored;
        std::filesystem::remove_all(fuzz::own_folder, ignored);
    });
    std::signal(SIGPROF, fuzz::onTimeOver);
    __sanitizer_install_malloc_and_free_hooks(fuzz::onAllocation, fuzz::onRelease);
    return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const fuzz::Bounds bounds(size);
    try {
        fuzz::readOne({reinterpret_cast<const char*>(data), size});
    } catch (const InputError& error) {
        if (std::strlen(error.what()) > fuzz::kLongestMessage)
            fuzz::finding(fmt::format("a message of {} letters", std::strlen(error.what())));
    }
    return 0;
}
