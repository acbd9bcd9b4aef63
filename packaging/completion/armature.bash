# SPDX-License-Identifier: Apache-2.0
# Completion of armature for bash; `armature complete` knows the words.
_armature() {
  mapfile -t COMPREPLY < <(armature complete -- "${COMP_WORDS[@]:1:COMP_CWORD}" 2>/dev/null)
  if [ ${#COMPREPLY[@]} -eq 0 ]; then
    compopt -o default  # files
  elif [[ ${COMPREPLY[0]} == *[.=] ]]; then
    compopt -o nospace
  fi
}
complete -F _armature armature
