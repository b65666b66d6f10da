#!/usr/bin/env bash
# Usage: check_names.sh ROOT
# Names in anonymous namespaces are unique within a folder: with CMAKE_UNITY_BUILD its sources are compiled as one, and
# there a function of another file may fit a call better than the one that was meant.
set -euo pipefail
cd "$1"

# Of each source: "FOLDER NAME FILE" for each function, type and constant that begins a line between `namespace {` and
# its end, and is not a member of a class.
names() {
  local folder
  for folder in $(find core sim solvers results studies app -type d); do
    for file in "$folder"/*.cpp; do
      [[ -e "$file" ]] || continue
      awk -v folder="$folder" -v file="${file##*/}" '
        /^namespace \{/ { inside = 1; next }
        /^\}  \/\/ namespace$/ { inside = 0; next }
        !inside || /^[ \t#}\/]/ || /^(using|namespace) / || !NF { next }
        {
          line = $0
          sub(/^template <.*> */, "", line)
          sub(/^\[\[[^]]*\]\] */, "", line)
          if (match(line, /^(struct|class|enum class|enum) [A-Za-z_0-9]+/)) {
            name = substr(line, RSTART, RLENGTH); sub(/.* /, "", name)
          } else if (match(line, /^[^(=;{]*[ *&][A-Za-z_0-9]+(\(| =|\{|;)/)) {
            name = substr(line, RSTART, RLENGTH); sub(/(\(| =|\{|;)$/, "", name); sub(/.*[ *&]/, "", name)
          } else next
          print folder, name, file
        }' "$file"
    done
  done
}

twice="$(names | sort -u | awk '{ files[$1 " " $2] = files[$1 " " $2] " " $3; count[$1 " " $2]++ }
  END { for (key in count) if (count[key] > 1) print key ":" files[key] }' | sort)"
if [[ -n "$twice" ]]; then
  echo "names that anonymous namespaces of a folder have twice (folder name: files):" >&2
  echo "$twice" >&2
  exit 1
fi
