# Sourced by the scripts here: --help as the first argument prints the comment at the head of the script, and nothing is done.
case ${1:-} in
  -h | --help)
    sed -n '2,${/^#/!q;s/^# \{0,1\}//p}' "$0"
    exit
    ;;
esac
