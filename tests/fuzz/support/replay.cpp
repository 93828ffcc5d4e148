// SPDX-License-Identifier: Apache-2.0
// Stands in for libFuzzer where the compiler has none: reads every input of some folders, and then, for some
// seconds, changed ones. It knows nothing of what has been covered, so it finds what comes back, and little
// that is new. Usage: fuzz_READER SECONDS MOST_BYTES FOLDER...
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

extern "C" {
int LLVMFuzzerInitialize(int* count, char*** words);
int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t most);
[[gnu::weak]] std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t most,
                                                  unsigned seed);
}

namespace {

namespace fs = std::filesystem;
using Bytes = std::vector<std::uint8_t>;

std::mt19937 chance(1);  // the same inputs in every run

std::size_t below(std::size_t count) {
    return std::uniform_int_distribution<std::size_t>(0, count - 1)(chance);
}

Bytes contentOf(const fs::path& path, std::size_t most) {
    std::ifstream file(path, std::ios::binary);
    Bytes bytes{std::istreambuf_iterator<char>(file), {}};
    bytes.resize(std::min(bytes.size(), most));
    return bytes;
}

std::vector<Bytes> contentsOf(int count, char** folders, std::size_t most) {
    std::vector<fs::path> paths;
    for (int i = 0; i < count; ++i)
        for (const fs::directory_entry& entry : fs::directory_iterator(folders[i]))
            if (entry.is_regular_file()) paths.push_back(entry.path());
    std::sort(paths.begin(), paths.end());
    std::vector<Bytes> contents = {Bytes()};
    for (const fs::path& path : paths)
        contents.push_back(contentOf(path, most));
    return contents;
}

Bytes changed(const Bytes& input, std::size_t most) {
    Bytes bytes = input;
    bytes.resize(most);
    bytes.resize(LLVMFuzzerCustomMutator ? LLVMFuzzerCustomMutator(bytes.data(), input.size(), most,
                                                                   static_cast<unsigned>(chance()))
                                         : LLVMFuzzerMutate(bytes.data(), input.size(), most));
    return bytes;
}

}  // namespace

/// A byte anew, a byte less or more, or a piece put elsewhere.
std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t most) {
    if (size == 0) {
        if (most > 0) data[0] = static_cast<std::uint8_t>(below(256));
        return std::min<std::size_t>(most, 1);
    }
    const std::size_t at = below(size), to = below(size);
    const std::size_t length = 1 + below(std::min<std::size_t>(size - std::max(at, to), 64));
    switch (below(5)) {
        case 0:
            data[at] = static_cast<std::uint8_t>(below(256));
            return size;
        case 1:
            data[at] ^= static_cast<std::uint8_t>(1u << below(8));
            return size;
        case 2:
            std::copy(data + at + 1, data + size, data + at);
            return size - 1;
        case 3:
            if (size == most) return size;
            std::copy_backward(data + at, data + size, data + size + 1);
            data[at] = static_cast<std::uint8_t>(below(256));
            return size + 1;
        default: {
            const Bytes piece(data + at, data + at + length);
            std::copy(piece.begin(), piece.end(), data + to);
            return size;
        }
    }
}

int main(int count, char** words) {
    if (count < 4) {
        fmt::print(stderr, "Usage: {} SECONDS MOST_BYTES FOLDER...\n", words[0]);
        return 2;
    }
    LLVMFuzzerInitialize(&count, &words);
    const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(std::atof(words[1]));
    const auto most = static_cast<std::size_t>(std::atoll(words[2]));
    const std::vector<Bytes> contents = contentsOf(count - 3, words + 3, most);
    std::size_t tried = 0;
    for (const Bytes& input : contents) {
        LLVMFuzzerTestOneInput(input.data(), input.size());
        ++tried;
    }
    for (; std::chrono::steady_clock::now() < end; ++tried) {
        const Bytes input = changed(contents[below(contents.size())], most);
        LLVMFuzzerTestOneInput(input.data(), input.size());
    }
    fmt::print("{} inputs, {} of them as they were made\n", tried, contents.size());
}
