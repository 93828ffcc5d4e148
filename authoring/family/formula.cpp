// SPDX-License-Identifier: Apache-2.0
#include "authoring/family/formula.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "base/json_shape.h"
#include "base/text/printable.h"

namespace throng::authoring {
namespace {

constexpr std::size_t kLongest = 1000;  // letters

bool isDigit(char letter) {
    return letter >= '0' && letter <= '9';
}
bool beginsName(char letter) {
    return (letter >= 'a' && letter <= 'z') || (letter >= 'A' && letter <= 'Z') || letter == '_';
}
bool isInName(char letter) {
    return beginsName(letter) || isDigit(letter) || letter == '.';
}

}  // namespace

/// By recursive descent: each rule leaves steps that leave one number more on the stack.
class FormulaParser {
  public:
    FormulaParser(std::string_view text, Formula& formula) : text_(text), formula_(formula) {}

    void parse() {
        if (text_.size() > kLongest)
            throw FormulaError(fmt::format("a formula has at most {} letters", kLongest), kLongest);
        sum(0);
        if (peek() != '\0') fail("expected +, -, *, / or the end");
    }

  private:
    using Kind = Formula::Kind;

    char peek() {
        while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\t'))
            ++at_;
        return at_ < text_.size() ? text_[at_] : '\0';
    }
    [[noreturn]] void fail(const std::string& expected) {
        const std::string found =
            at_ < text_.size() ? fmt::format("`{}`", printable(text_.substr(at_, 1))) : "the end";
        throw FormulaError(fmt::format("{}, found {}", expected, found), at_);
    }
    void expect(char letter) {
        if (peek() != letter) fail(fmt::format("expected `{}`", letter));
        ++at_;
    }
    void add(Kind kind, std::size_t at, double number = 0.0, std::size_t count = 0) {
        formula_.steps_.push_back({kind, at, number, count});
    }

    void sum(std::size_t depth) {
        product(depth);
        for (char sign = peek(); sign == '+' || sign == '-'; sign = peek()) {
            const std::size_t at = at_++;
            product(depth);
            add(sign == '+' ? Kind::add : Kind::subtract, at);
        }
    }
    void product(std::size_t depth) {
        factor(depth);
        for (char sign = peek(); sign == '*' || sign == '/'; sign = peek()) {
            const std::size_t at = at_++;
            factor(depth);
            add(sign == '*' ? Kind::multiply : Kind::divide, at);
        }
    }
    void factor(std::size_t depth) {
        const char first = peek();
        if (depth > kMostDepth)
            throw FormulaError(fmt::format("brackets and signs are nested more than {} deep", kMostDepth),
                               at_);
        if (first == '-') {
            const std::size_t at = at_++;
            factor(depth + 1);
            add(Kind::negate, at);
        } else if (first == '(') {
            ++at_;
            sum(depth + 1);
            expect(')');
        } else if (isDigit(first) || first == '.') {
            number();
        } else if (beginsName(first)) {
            nameOrFunction(depth);
        } else {
            fail("expected a number, the name of an axis or `(`");
        }
    }
    void number() {
        double value = 0.0;
        const char* const begin = text_.data() + at_;
        const auto [end, error] = std::from_chars(begin, text_.data() + text_.size(), value);
        if (error != std::errc()) fail("expected a number");
        const std::size_t at = at_;
        at_ += static_cast<std::size_t>(end - begin);
        add(Kind::number, at, value);
    }
    void nameOrFunction(std::size_t depth) {
        const std::size_t at = at_;
        while (at_ < text_.size() && isInName(text_[at_]))
            ++at_;
        const std::string word(text_.substr(at, at_ - at));
        if (peek() != '(') return name(word, at);
        if (word != "min" && word != "max")
            throw FormulaError(fmt::format("there is no function `{}`: there are min and max", word), at);
        ++at_;
        sum(depth + 1);
        std::size_t count = 1;
        for (; peek() == ','; ++count) {
            ++at_;
            sum(depth + 1);
        }
        expect(')');
        add(word == "min" ? Kind::least : Kind::most, at, 0.0, count);
    }
    void name(const std::string& word, std::size_t at) {
        auto& names = formula_.names_;
        const auto known = std::ranges::find(names, word, &Formula::Name::name);
        const auto index = static_cast<std::size_t>(known - names.begin());
        if (known == names.end()) names.push_back({word, at});
        add(Kind::name, at, 0.0, index);
    }

    std::string_view text_;
    Formula& formula_;
    std::size_t at_ = 0;
};

Formula::Formula(std::string_view text) {
    FormulaParser(text, *this).parse();
}

double Formula::evaluate(const std::function<double(const std::string&)>& value_of) const {
    std::vector<double> stack;
    const auto pop = [&] {
        const double top = stack.back();
        stack.pop_back();
        return top;
    };
    const auto ofTwo = [&](const Step& step, double a, double b) {
        switch (step.kind) {
            case Kind::add:
                return a + b;
            case Kind::subtract:
                return a - b;
            case Kind::multiply:
                return a * b;
            default:
                if (b == 0.0) throw FormulaError(fmt::format("{:g} is divided by zero", a), step.at);
                return a / b;
        }
    };
    for (const Step& step : steps_) {
        if (step.kind == Kind::number) {
            stack.push_back(step.number);
        } else if (step.kind == Kind::name) {
            stack.push_back(value_of(names_[step.count].name));
        } else if (step.kind == Kind::negate) {
            stack.back() = -stack.back();
        } else if (step.kind == Kind::least || step.kind == Kind::most) {
            double value = pop();
            for (std::size_t i = 1; i < step.count; ++i) {
                const double other = pop();
                value = step.kind == Kind::least ? std::min(value, other) : std::max(value, other);
            }
            stack.push_back(value);
        } else {
            const double right = pop();
            const double left = pop();
            stack.push_back(ofTwo(step, left, right));
        }
        if (!std::isfinite(stack.back())) throw FormulaError("this is beyond all bounds", step.at);
    }
    return stack.empty() ? 0.0 : stack.back();
}

}  // namespace throng::authoring
