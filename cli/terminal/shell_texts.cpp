// SPDX-License-Identifier: Apache-2.0
#include "cli/terminal/shell_texts.h"

#include <fmt/format.h>

#include <functional>
#include <string_view>
#include <vector>

namespace throng::cli {
namespace {

/// An option as shells see it.
struct Spelled {
    std::vector<std::string> names;  ///< "--force", "-q"
    std::string meaning;
    std::vector<std::string> choices;  ///< of its value, where these are few
    bool takes_value = false;
};

/// The words of a type that is written as TEXT:{cpu,gpu}.
std::vector<std::string> choicesIn(const std::string& type) {
    std::vector<std::string> words;
    const std::size_t open = type.find('{'), close = type.rfind('}');
    if (open == std::string::npos || close == std::string::npos) return words;
    for (std::size_t from = open + 1; from < close;) {
        const std::size_t end = std::min(type.find(',', from), close);
        words.push_back(type.substr(from, end - from));
        from = end + 1;
    }
    return words;
}

std::vector<Spelled> optionsOf(const CLI::App& command) {
    std::vector<Spelled> options;
    for (const CLI::Option* option : command.get_options()) {
        if (option->get_group().empty()) continue;  // is not shown in --help either
        Spelled spelled;
        for (const std::string& name : option->get_lnames())
            spelled.names.push_back("--" + name);
        for (const std::string& name : option->get_snames())
            spelled.names.push_back("-" + name);
        if (spelled.names.empty()) continue;  // an argument without a name
        spelled.meaning = option->get_description();
        spelled.takes_value = option->get_type_size() > 0;
        if (spelled.takes_value) spelled.choices = choicesIn(option->get_type_name());
        options.push_back(std::move(spelled));
    }
    return options;
}

using Visit = std::function<void(const std::string& path, const CLI::App& command)>;

/// All commands, each with its words, " batch query": the program itself first, with none.
void visitAll(const CLI::App& command, const std::string& path, const Visit& visit) {
    visit(path, command);
    for (const CLI::App* inner : command.get_subcommands({}))
        visitAll(*inner, path + " " + inner->get_name(), visit);
}

std::string joined(const std::vector<std::string>& words) {
    return fmt::format("{}", fmt::join(words, " "));
}

std::string replaced(std::string text, std::string_view what, std::string_view by) {
    for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + by.size()))
        text.replace(at, what.size(), by);
    return text;
}

/// In single quotation marks.
std::string quoted(const std::string& text) {
    return "'" + replaced(text, "'", R"('\'')") + "'";
}

/// The lines of a `case` that tell commands' words apart: the same in bash and zsh.
std::string commandPatterns(const CLI::App& app) {
    std::string patterns;
    visitAll(app, "", [&](const std::string& path, const CLI::App&) {
        if (!path.empty()) patterns += fmt::format("{}\"{}\"", patterns.empty() ? "" : "|", path);
    });
    return patterns;
}

std::string rowsOf(const CLI::App& command) {
    std::string rows;
    const auto row = [&](const std::string& name, const std::string& meaning) {
        rows += fmt::format("                {}\n", quoted(replaced(name, ":", "\\:") + ":" + meaning));
    };
    for (const CLI::App* inner : command.get_subcommands({}))
        row(inner->get_name(), inner->get_description());
    for (const Spelled& option : optionsOf(command))
        for (const std::string& name : option.names)
            row(name, option.meaning);
    return rows;
}

constexpr const char* kBash = R"(# bash completion for throng
_throng() {{
    local word=${{COMP_WORDS[COMP_CWORD]}} before=${{COMP_WORDS[COMP_CWORD - 1]}} path="" words="" i
    for ((i = 1; i < COMP_CWORD; i++)); do
        case "$path ${{COMP_WORDS[i]}}" in
            {}) path="$path ${{COMP_WORDS[i]}}" ;;
        esac
    done
    case "$path $before" in
{}    esac
    if [ -z "$words" ]; then
        case "$path${{word:0:1}}" in
{}        esac
    fi
    COMPREPLY=($(compgen -W "$words" -- "$word"))
}}
complete -o default -F _throng throng
)";

constexpr const char* kZsh = R"(#compdef throng
_throng() {{
    local known="" i
    local -a rows
    for ((i = 2; i < CURRENT; i++)); do
        case "$known ${{words[i]}}" in
            {}) known="$known ${{words[i]}}" ;;
        esac
    done
    case "$known ${{words[CURRENT - 1]}}" in
{}    esac
    case "$known" in
{}    esac
    _describe throng rows
    [[ $PREFIX == -* ]] || _files
}}
if [ "$funcstack[1]" = _throng ]; then _throng "$@"; else compdef _throng throng; fi
)";

/// @param line what one option with such words becomes: its place and the words
std::string choiceLines(const CLI::App& app, fmt::format_string<std::string, std::string> line) {
    std::string lines;
    visitAll(app, "", [&](const std::string& path, const CLI::App& command) {
        for (const Spelled& option : optionsOf(command))
            for (const std::string& name : option.names)
                if (!option.choices.empty())
                    lines += fmt::format(line, fmt::format("{} {}", path, name), joined(option.choices));
    });
    return lines;
}

std::string roff(const std::string& text) {
    std::string line = replaced(replaced(text, "\\", "\\e"), "-", "\\-");
    return line.starts_with('.') || line.starts_with('\'') ? "\\&" + line : line;
}

/// What help says at its end: examples keep their lines.
std::string roffFooter(const std::string& text) {
    if (text.empty()) return "";
    std::string lines = ".PP\n.nf\n";
    for (std::size_t from = 0; from < text.size();) {
        const std::size_t end = std::min(text.find('\n', from), text.size());
        lines += roff(text.substr(from, end - from)) + "\n";
        from = end + 1;
    }
    return lines + ".fi\n";
}

std::string roffOptions(const CLI::App& command) {
    std::string text;
    for (const CLI::Option* option : command.get_options()) {
        if (option->get_group().empty()) continue;
        const std::string type = option->get_type_size() > 0 ? " " + option->get_type_name() : "";
        text += fmt::format(".TP\n.B {}\n{}\n", roff(option->get_name(option->get_positional(), true) + type),
                            roff(option->get_description()));
    }
    return text;
}

}  // namespace

std::string bashCompletions(const CLI::App& app) {
    std::string words;
    visitAll(app, "", [&](const std::string& path, const CLI::App& command) {
        std::vector<std::string> inside, options;
        for (const CLI::App* inner : command.get_subcommands({}))
            inside.push_back(inner->get_name());
        for (const Spelled& option : optionsOf(command))
            options.insert(options.end(), option.names.begin(), option.names.end());
        words += fmt::format("            \"{}-\") words=\"{}\" ;;\n", path, joined(options));
        if (!inside.empty())
            words += fmt::format("            \"{}\"?|\"{}\") words=\"{}\" ;;\n", path, path, joined(inside));
    });
    return fmt::format(kBash, commandPatterns(app), choiceLines(app, "        \"{}\") words=\"{}\" ;;\n"),
                       words);
}

std::string zshCompletions(const CLI::App& app) {
    std::string rows;
    visitAll(app, "", [&](const std::string& path, const CLI::App& command) {
        rows +=
            fmt::format("        \"{}\")\n            rows=(\n{}            ) ;;\n", path, rowsOf(command));
    });
    return fmt::format(kZsh, commandPatterns(app),
                       choiceLines(app, "        \"{}\") compadd -- {}; return ;;\n"), rows);
}

std::string fishCompletions(const CLI::App& app) {
    std::string text = "# fish completion for throng\n";
    visitAll(app, "", [&](const std::string& path, const CLI::App& command) {
        constexpr std::string_view kAnd = "; and ";
        const std::string seen =
            path.empty() ? "__fish_use_subcommand"
                         : replaced(path, " ", "; and __fish_seen_subcommand_from ").substr(kAnd.size());
        for (const CLI::App* inner : command.get_subcommands({}))
            text += fmt::format("complete -c throng -n {} -a {} -d {}\n", quoted(seen), inner->get_name(),
                                quoted(inner->get_description()));
        for (const Spelled& option : optionsOf(command)) {
            text += fmt::format("complete -c throng -n {}", quoted(seen));
            for (const std::string& name : option.names)
                text += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
            if (option.takes_value) text += " -r";
            if (!option.choices.empty()) text += fmt::format(" -f -a {}", quoted(joined(option.choices)));
            text += fmt::format(" -d {}\n", quoted(option.meaning));
        }
    });
    return text;
}

std::string manualPage(const CLI::App& app) {
    std::string text = fmt::format(
        ".TH THRONG 1 \"\" \"throng {}\" \"User Commands\"\n.SH NAME\nthrong \\- bakes crowds\n.SH SYNOPSIS\n"
        ".B throng\n.I COMMAND\n[OPTIONS]\n.SH DESCRIPTION\n{}\n.SH OPTIONS\n{}.SH COMMANDS\n",
        THRONG_VERSION, roff(app.get_description()), roffOptions(app));
    visitAll(app, "", [&](const std::string& path, const CLI::App& command) {
        if (path.empty()) return;
        text += fmt::format(".SS throng{}\n{}.\n{}{}", roff(path), roff(command.get_description()),
                            roffOptions(command), roffFooter(command.get_footer()));
    });
    return text + ".SH NOTES\n" + roffFooter(app.get_footer());
}

}  // namespace throng::cli
