// SPDX-License-Identifier: Apache-2.0
// Somebody is in between: who does not get on lets its company be.

/// How much, 0 to 1.
float lettingCompanyBe(float nervousness) {
    return smoothstep(WAITING_FOR_COMPANY_GIVES_UP, WAITING_FOR_COMPANY_GIVEN_UP, nervousness);
}
