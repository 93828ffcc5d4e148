// SPDX-License-Identifier: Apache-2.0
// The database of a batch, and what `throng batch query` and `throng report` ask it.
#include "base/files/errors.h"
#include "cli/batch/results_query.h"
#include "support/harness.h"

using namespace throng;

void fuzz::readOne(std::string_view input) {
    const std::filesystem::path database = put("results.sqlite", input);
    for (const char* question :
         {"SELECT * FROM results ORDER BY number", "SELECT key, value FROM batch",
          "SELECT * FROM scenarios LIMIT 0",
          "SELECT number, id, reason, log FROM scenarios WHERE status = 'failed' ORDER BY number"})
        try {
            const cli::QueryResult result = cli::queryResults(database, question);
            static_cast<void>(cli::csvOf(result));
            static_cast<void>(cli::tableOf(result));
            static_cast<void>(cli::jsonOf(result));
        } catch (const InputError&) {
            // The other questions may have answers.
        }
}
