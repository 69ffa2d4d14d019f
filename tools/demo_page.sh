#!/usr/bin/env bash
# Writes FOLDER/index.html from tools/report/page/demo.html and from what each step of tools/demo.sh left in the folder:
# NAME.command, NAME.exit (its exit code) and NAME.txt (its output).
# Usage: demo_page.sh FOLDER VERSION
set -eu
folder=$1 version=$2
template=$(dirname "$0")/report/page

escape() { sed 's/&/\&amp;/g; s/</\&lt;/g; s/>/\&gt;/g'; }
page=$(<"$template/demo.html")
fill() { page=${page//"@$1@"/"$2"}; } # MARK TEXT

# The last lines of a step's output, without the names of files.
declare -A lines=([cbox]=3 [glass]=3 [validate]=1 [converge]=4)
printed() { grep -v '^page: \|^data and plots: ' "$folder/$1.txt" | tail -n "${lines[$1]}" | escape; }

failed=0
for name in cbox glass validate converge; do
  status='<p class="status">passed</p>'
  code=$(<"$folder/$name.exit")
  if [ "$code" -ne 0 ]; then
    status="<p class=\"status failed\">failed with exit code $code</p>"
    failed=$((failed + 1))
  fi
  fill "$name.status" "$status"
  fill "$name" "<b>\$ $(escape <"$folder/$name.command")</b>
$(printed "$name")"
done
fill CSS "$(<"$template/page.css")"
fill VERSION "$version"
fill STATUS "$([ $failed -eq 0 ] && echo pass || echo fail)"
fill TITLE "$([ $failed -eq 0 ] && echo "All four steps passed" || echo "$failed of four steps failed")"
printf '%s\n' "$page" >"$folder/index.html.tmp"
mv "$folder/index.html.tmp" "$folder/index.html"
