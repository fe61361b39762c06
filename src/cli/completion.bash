# SPDX-License-Identifier: GPL-2.0-or-later
# Completion of qmorph's options in bash: those that its --help lists.
_qmorph() {
  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]} choices=
  case $before in
    --layers) choices='on off' ;;
    --for) choices='dealii mfem dolfinx elmer su2 calculix abaqus openfoam specfem2d' ;;
    --elements) choices='CPS CPE CAX S M3D CPSR CPER CAXR SR M3DR' ;;
    --stage) choices='input front elimination smoothing cleanup final' ;;
    --colour) choices='sj eta thesis size none' ;;
    --from) choices='x y z -x -y -z' ;;
    --smoothing) choices='shape_energy thesis' ;;
    *) [[ $word == -* ]] && choices=$("$1" --help 2>/dev/null | grep -oE '(^|[[:space:]])--?[a-zA-Z0-9][a-zA-Z0-9_-]*') ;;
  esac
  mapfile -t COMPREPLY < <(if [[ $choices ]]; then compgen -W "$choices" -- "$word"; else compgen -f -- "$word"; fi)
}
complete -o filenames -F _qmorph qmorph
